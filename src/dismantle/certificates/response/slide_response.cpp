// SPDX-License-Identifier: Apache-2.0
// Response Slide: the motions along contacts of one step.
#include "dismantle/certificates/response/certificate_response.h"
#include "dismantle/certificates/response/slide_state.h"
#include "dismantle/engine/chords.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

using Twist = SlideContacts::Twist;

/// Sweeps of one step, apart from free ones of an unbounded motion.
constexpr int kMaxTries = 40;
/// Tries that are exempt from the limit of tests.
constexpr int kCertainTries = 1;
/// A step ends before a motion along contacts that makes less than this share of what is still wanted, or after it if
/// it is the step's first: the next step goes on.
constexpr double kCreepShare = 0.1;
/// A rotation that was not asked for is made only where it brings the set this share of what is wanted further on: what
/// is pressed straight on does not tilt for the little that a contact beside its middle would yield.
constexpr double kTiltShare = 0.1;
/// Weighs rotations against translations in a motion that is to be without rotation, in characteristic lengths.
constexpr double kNoRotation = 1e3;
/// Contacts that let the set hardly move are found again this many times in a row, then ever more rarely.
constexpr unsigned kAlwaysSearchAgain = 4;
/// The set goes on towards its target as far as nothing blocks it, not along contacts, where that brings it further by
/// this share of the tolerance. Contacts ahead may leave less room than there is, as each of them is taken for a
/// half-space.
constexpr double kStraightGain = 0.5;
/// Upper bound of how far the second-order part of a twist may move a point, as a share of the tolerance.
constexpr double kBendShare = 0.3;
/// A part of a motion up to its first contact that is blocked itself is halved this many times.
constexpr int kMaxHalvings = 2;
/// Contacts are kept while their gap is at most this many tolerances.
constexpr double kContactReach = 8;

}  // namespace

void CertificateResponse::slide(const Pose& target, StepResult& result) {
  const double tolerance = sweeper_.tolerance(), rest = kRestShare * tolerance;
  SlideState state;
  state.target = target;
  // After a step that ended at the limit, contacts are kept as they are: choosing axes again would drop those that do
  // not block the motion to the target.
  state.axes_chosen = std::exchange(keeps_axes_, false) || contacts_.empty();
  state.contacts_here = contacts_.empty();
  const std::size_t limit = sweeper_.options().slide_tests;
  while (state.tries < kMaxTries) {
    const bool is_long =
        limit > 0 && state.tries >= kCertainTries && result.cost.tests + result.cost.depth_tests >= limit;
    if (is_long || sweeper_.is_used_up()) {
      unfinished_ = true;
      keeps_axes_ = state.axes_chosen;
      break;
    }
    const SlideTrial trial = choose_trial(state);
    if (is_better_straight(trial.share, state) && go_straight(state, result)) continue;
    if (!state.contacts_here && (trial.travel < rest || trial.creeping) && search_again()) {
      // Among many pairs, one that was left behind may be what holds the set.
      contacts_.drop_pairs();
      state.axes_chosen = state.contacts_here = true;
      ++state.tries;
      continue;
    }
    if (trial.travel < rest || (trial.creeping && !result.poses.empty())) break;

    const ScrewMotion motion = within_arcs(trial.motion);
    const CertificateSweep found = sweep(motion, contact_window(trial), state.budget, result);
    result.clearance = found.clearance;
    if (undecided_) {  // the next step goes on where this one ended
      // A shorter motion is decided sooner.
      reach_ = std::max(kMinTry * tolerance, 2 * (found.complete ? found.toi : 0) * trial.travel);
      if (found.complete) make_part(motion, found.toi, motion.deviation == 0, result);
      keeps_axes_ = state.axes_chosen;
      break;
    }
    if (found.cut) {
      // More certificates hold for a shorter motion.
      reach_ = std::max(kMinTry * tolerance, trial.travel / kTryGrowth);
      if (found.blocked.empty() && found.fits.empty()) {
        keeps_axes_ = state.axes_chosen;
        break;
      }
    }
    if (!found.free) report(found, result);
    state.tries += !found.free || trial.twist.bounded;
    const bool goes_on =
        found.free ? make_free(trial, motion, state, result) : make_blocked(trial, motion, found, state, result);
    if (!goes_on) break;
  }
  end_slide(target, result);
}

double CertificateResponse::contact_window(const SlideTrial& trial) const {
  return std::max(kContactWindow, kContactReach * sweeper_.tolerance() / trial.travel);
}

CertificateResponse::SlideTrial CertificateResponse::choose_trial(SlideState& state) {
  const double characteristic_length = std::max(sweeper_.radius() / 2, sweeper_.tolerance());
  const ScrewMotion to_target = sweeper_.motion_to(state.target);
  const Twist wanted = twist_of(to_target);
  const Twist tried = shortened(wanted, reach_);
  const bool whole = travel_of(tried) >= travel_of(wanted);
  if (!std::exchange(state.axes_chosen, true))
    contacts_.choose_axes(within_arcs(whole ? to_target : sweeper_.motion_to(twisted(tried))));
  Twist allowed = contacts_.nearest(tried, characteristic_length);
  if (allowed.bounded) {
    // The velocity of a long screw points away from its end: pressed on, the set would drift off along the contact.
    allowed = contacts_.nearest(shortened(straight_to(state.target), reach_), characteristic_length);
    allowed.bounded = true;
  }
  if (allowed.bounded && length(wanted.rotation) < kScrewMinimumAngle) {
    const Twist straight = contacts_.nearest(tried, kNoRotation * characteristic_length);
    const double gain = dot(allowed.velocity - straight.velocity, tried.velocity);
    if (gain < kTiltShare * length_squared(tried.velocity)) allowed = {straight.velocity, {}, true};
  }
  const Twist twist = bent_little(allowed);
  const bool creeping = twist.bounded && travel_of(allowed) < kCreepShare * travel_of(tried);
  const auto product = [&](const Twist& a, const Twist& b) {
    return dot(a.velocity, b.velocity) + characteristic_length * characteristic_length * dot(a.rotation, b.rotation);
  };
  return {twist, travel_of(twist), product(twist, wanted) / product(wanted, wanted), creeping,
          twist.bounded || !whole ? sweeper_.motion_to(twisted(twist)) : to_target};
}

bool CertificateResponse::is_better_straight(double share, const SlideState& state) const {
  if (!state.straight) return false;
  const double gain = state.straight->share - share;
  return gain * sweeper_.motion_to(state.target).path_length > kStraightGain * sweeper_.tolerance();
}

bool CertificateResponse::go_straight(SlideState& state, StepResult& result) {
  const SlideState::Straight part = *std::exchange(state.straight, {});
  const bool was_undecided = undecided_;
  ++state.tries;
  if (!make_part(part.motion, part.fraction, part.is_certain, result)) {
    undecided_ = was_undecided;  // the motion along contacts is tried in its place
    return false;
  }
  state.axes_chosen = state.on_course = state.contacts_here = false;
  hardly_moved_ = 0;
  return true;
}

bool CertificateResponse::make_free(const SlideTrial& trial, const ScrewMotion& motion, SlideState& state,
                                    StepResult& result) {
  advance(motion, 1, result);
  state.straight.reset();
  const bool was_on_course = std::exchange(state.on_course, !trial.twist.bounded);
  // Motions along one screw are reported as one.
  if (was_on_course && state.on_course) result.poses.erase(result.poses.end() - 2);
  reach_ *= kTryGrowth;
  state.axes_chosen = state.contacts_here = false;
  if (!trial.creeping) hardly_moved_ = 0;
  return !trial.creeping && !(sweeper_.pose() == state.target);
}

bool CertificateResponse::make_blocked(const SlideTrial& trial, const ScrewMotion& motion,
                                       const CertificateSweep& found, SlideState& state, StepResult& result) {
  bool news = false;
  double fraction = found.toi;
  for (const SweepContact& pair : found.blocked) {
    news |= contacts_.add(pair);
    fraction = std::min(fraction, contacts_.fraction_within_reserve(pair));
  }
  for (const BlockedFit& fit : found.fits) news |= contacts_.add_fit(fit);
  if (!trial.twist.bounded && found.fits.empty()) {
    // With the reserve used up, the next rotation would be held at once.
    const double before = found.toi - contacts_.reserve() / motion.path_length;
    const double share = trial.share * motion.path_length / trial.motion.path_length;
    state.straight = {motion, before, before * share, found.complete && motion.deviation == 0};
  }
  if (news) return true;
  if (!found.fits.empty()) {
    state.budget = SweepBudget::Bounded;
    return true;
  }
  if (!found.complete) {
    // Other pairs may block earlier: all of them have to be examined up to where these allow the motion.
    reach_ = fraction * trial.travel;
    if (reach_ >= kRestShare * sweeper_.tolerance()) return true;
    reach_ = kMinTry * sweeper_.tolerance();  // of the next step: this one ends
    return false;
  }
  reach_ = std::max(kMinTry * sweeper_.tolerance(), 2 * found.toi * trial.travel);
  if (is_better_straight(fraction * trial.share, state) && go_straight(state, result)) return true;
  state.straight.reset();
  if (!make_part(motion, fraction, motion.deviation == 0, result)) return false;
  state.axes_chosen = state.on_course = state.contacts_here = false;
  if (!trial.creeping) hardly_moved_ = 0;
  return true;
}

bool CertificateResponse::make_part(const ScrewMotion& motion, double fraction, bool is_certain, StepResult& result) {
  for (int halvings = 0; halvings <= kMaxHalvings; ++halvings, fraction /= 2) {
    if (fraction * motion.path_length < kRestShare * sweeper_.tolerance()) return false;
    const ScrewMotion part = is_certain ? motion : sweeper_.motion_to(motion.at(fraction));
    if (!is_certain && !sweep(part, kContactWindow, SweepBudget::Bounded, result).free) continue;
    advance(part, is_certain ? fraction : 1, result);
    return true;
  }
  return false;
}

bool CertificateResponse::search_again() {
  ++hardly_moved_;
  return hardly_moved_ <= kAlwaysSearchAgain || (hardly_moved_ & (hardly_moved_ - 1)) == 0;
}

void CertificateResponse::end_slide(const Pose& target, StepResult& result) {
  const ScrewMotion left = sweeper_.motion_to(target);
  const double tolerance = sweeper_.tolerance();
  if (left.path_length > 0 && left.path_length <= contacts_.withheld()) {
    const CertificateSweep found = sweep(left, kContactWindow, SweepBudget::Bounded, result);
    if (found.free) {
      advance(left, 1, result);
      result.clearance = std::min(result.clearance, found.clearance);
    }
  }
  // Where the step ended at the limit, the next one may need what was found ahead.
  if (!keeps_axes_) contacts_.drop_beyond(kContactReach * tolerance);
  result.contact_points = contacts_.points(tolerance);
  // No triangles were reported for contacts of whole cylinders.
  if (!result.blocking_pairs.empty()) return;
  for (const ContactPoint& c : result.contact_points) result.blocking_pairs.push_back(blocking_pair_of(c, 0));
}

Twist CertificateResponse::bent_little(Twist twist) const {
  const double bend = sweeper_.radius() * length_squared(twist.rotation) / 2;
  const double max_bend = kBendShare * sweeper_.tolerance();
  if (!twist.bounded || bend <= max_bend) return twist;
  const double scale = std::sqrt(max_bend / bend);
  return {scale * twist.velocity, scale * twist.rotation, true};
}

ScrewMotion CertificateResponse::within_arcs(const ScrewMotion& motion) const {
  const double limit = kArcShare * sweeper_.tolerance();
  if (motion.deviation <= limit) return motion;
  return sweeper_.motion_to(motion.at(std::sqrt(limit / motion.deviation) * (1 - 1e-6)));
}

Twist CertificateResponse::twist_of(const ScrewMotion& motion) const {
  const Screw& screw = motion.screw;
  const Vec3 turn = screw.angle * screw.axis;
  return {screw.velocity + cross(turn, sweeper_.center() - screw.reference), turn, false};
}

Twist CertificateResponse::straight_to(const Pose& target) const {
  const Screw screw = sweeper_.motion_to(target).screw;
  const Vec3 end = transform_from_pose(target) * (inverse(transform_from_pose(sweeper_.pose())) * sweeper_.center());
  return {end - sweeper_.center(), screw.angle * screw.axis, false};
}

double CertificateResponse::travel_of(const Twist& twist) const {
  return length(twist.velocity) + sweeper_.radius() * length(twist.rotation);
}

Twist CertificateResponse::shortened(Twist twist, double max_travel) const {
  const double travel = travel_of(twist);
  if (travel <= max_travel) return twist;
  const double scale = max_travel / travel;
  return {scale * twist.velocity, scale * twist.rotation, twist.bounded};
}

Pose CertificateResponse::twisted(const Twist& twist) const {
  Screw screw;
  screw.reference = sweeper_.center();
  screw.velocity = twist.velocity;
  const double angle = length(twist.rotation);
  if (angle >= kScrewMinimumAngle) {
    screw.angle = angle;
    screw.axis = twist.rotation / angle;
    return screw_at(screw, 1) * sweeper_.pose();
  }
  return {sweeper_.pose().position + twist.velocity, sweeper_.pose().rotation};
}

}  // namespace dismantle
