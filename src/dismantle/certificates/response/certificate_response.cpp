// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/response/certificate_response.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

using Clock = std::chrono::steady_clock;

/// A motion that goes on to the contact ends this share of the tolerance before it [of path length], so that the next
/// sweep does not start on the very edge of what is allowed.
constexpr double kBackoffShare = 1e-3;
/// Motions shorter than this share of the tolerance are not made: what rests stays where it is, bit for bit.
constexpr double kRestShare = 2e-3;
/// Sweeps of one step of response Slide, apart from free ones of an unbounded motion.
constexpr int kMaxTries = 40;
/// A step ends before a motion along contacts that makes less than this share of what is still wanted, or with it where
/// it is the step's first: the next goes on.
constexpr double kCreepShare = 0.1;
/// Contacts that let the set hardly move are found anew so many times in a row, and then ever more seldom.
constexpr unsigned kAlwaysLookAgain = 4;
/// How far a twist's second-order part may take a point, as a share of the tolerance.
constexpr double kBendShare = 0.3;
/// Contacts are taken up while their gap is at most so many tolerances.
constexpr double kContactReach = 8;
/// After a motion that was stopped the next one is tried up to so many tolerances, or twice what was made.
constexpr double kMinTry = 4;
constexpr double kTryGrowth = 4;
/// How often the guard may shorten a motion before it is not made at all.
constexpr int kGuardTries = 4;

int cut_count(double deviation, double limit) {
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(deviation / limit))));
}

/// @param pair of a moving and a fixed component, and a face of each
template <class Pair>
CollisionContact contact_of(const Pair& pair, double toi) {
  if (pair.moving < pair.fixed) return {pair.moving, pair.fixed, pair.face_moving, pair.face_fixed, toi};
  return {pair.fixed, pair.moving, pair.face_fixed, pair.face_moving, toi};
}

}  // namespace

CertificateResponse::CertificateResponse(CertificateSweeper& sweeper, const Assembly& assembly, const PairStates& pairs)
    : sweeper_(sweeper),
      guard_(
          assembly, pairs, [&sweeper](ComponentId c) -> const SolidTree& { return sweeper.solid(c); },
          sweeper.executor()),
      embedded_(assembly, pairs, sweeper.executor()),
      from_(assembly.components.size()),
      to_(assembly.components.size()),
      held_(assembly.components.size()),
      contacts_(sweeper),
      reach_(std::numeric_limits<double>::infinity()) {
  guard_.prepare();
}

StepResult CertificateResponse::step(const Pose& target, ResponseKind response) {
  const Clock::time_point start = Clock::now();
  StepResult result;
  result.pose = sweeper_.pose();
  if (result.pose == target) {
    result.reached = true;
  } else if (response == ResponseKind::Slide) {
    slide(target, result);
  } else {
    go(target, response == ResponseKind::Touch, result);
  }
  result.pose = sweeper_.pose();
  result.reached = result.pose == target;
  if (result.reached) result.contacts.clear();
  result.sizes.intersection_pairs = embedded_.pairs().size();
  result.timings.overall = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  result.timings.front = result.timings.overall;
  return result;
}

CertificateSweep CertificateResponse::sweep(const Pose& end, double window, Effort effort, StepResult& result) {
  CertificateSweep found = sweeper_.sweep(end, window, effort);
  ++result.sweeps;
  result.sizes.elementary_tests += found.leaf_tests;
  result.sizes.answered_tests += found.answered_tests;
  result.sizes.triangle_pairs += found.leaf_tests;
  result.sizes.front = found.front;
  for (const auto& [moving, fixed] : found.touching) guard_.consider(moving, fixed, sweeper_.allowed(moving, fixed));
  touching_ = found.touching;
  return found;
}

double CertificateResponse::advance(const Pose& end, double part, StepResult& result, Guarded guarded) {
  const Pose start = sweeper_.pose();
  const double made = part > 0 ? follow(end, part, guarded) : 0;
  if (!(made > 0)) return 0;
  sweeper_.move_to(pose_between(start, end, made));
  adopt_parted();
  result.way.push_back(sweeper_.pose());
  return made;
}

double CertificateResponse::follow(const Pose& end, double part, Guarded guarded) {
  guarded_.clear();
  part = guarded_part(end, part, guarded);
  if (part <= 0) return 0;
  if (!embedded_.empty()) {
    for (std::size_t c = 0; c < held_.size(); ++c)
      held_[c] = sweeper_.holds(ComponentId(static_cast<std::uint32_t>(c)));
    const Pose start = sweeper_.pose(), stop = pose_between(start, end, part);
    const double most = kArcShare * sweeper_.tolerance();
    const double made =
        embedded_.follow(held_, sweeper_.poses(), start, stop, cut_count(sweeper_.deviation(stop), most), most);
    if (made < 1) {
      part *= made;
      part = part > 0 ? guarded_part(end, part, guarded) : 0;
    }
  }
  if (part > 0 && !guard_.watches_nothing()) guard_.commit();
  return part;
}

double CertificateResponse::guarded_part(const Pose& end, double part, Guarded guarded) {
  if (guard_.watches_nothing()) return part;
  const Pose start = sweeper_.pose();
  for (std::size_t c = 0; c < from_.size(); ++c) from_[c] = to_[c] = transform_from_pose(sweeper_.poses()[c]);
  for (int tries = 0; tries < kGuardTries; ++tries) {
    const RigidTransform next = transform_from_pose(pose_between(start, end, part));
    for (const ComponentId c : sweeper_.held()) to_[c.value] = next;
    std::vector<VertexContact> found = guard_.sweep(from_, to_, touching_);
    if (found.empty()) return part;
    double toi = 1;
    for (const CollisionContact& c : found) toi = std::min(toi, c.toi);
    part *= toi * (1 - kBackoffShare);
    guarded_ = std::move(found);
    if (guarded == Guarded::Whole) break;
  }
  return 0;
}

void CertificateResponse::adopt_parted() {
  for (const ComponentPair& pair : embedded_.take_parted()) sweeper_.part(pair.a, pair.b);
}

void CertificateResponse::report(const CertificateSweep& sweep, StepResult& result) const {
  result.contacts.clear();
  for (const BlockedPair& b : sweep.blocked) {
    if (b.toi > sweep.toi + kContactWindow) continue;
    result.contacts.push_back(contact_of(b, b.toi));
  }
}

void CertificateResponse::go(const Pose& target, bool touch, StepResult& result) {
  const Pose start = sweeper_.pose();
  const double travel = sweeper_.travel(target), tolerance = sweeper_.tolerance();
  const int cuts = cut_count(sweeper_.deviation(target), kArcShare * tolerance);
  for (double at = 0; at < 1;) {
    // Stop is all or nothing; Touch, once stopped, tries little first: what lies behind a contact costs most.
    const double part = touch ? std::min(1.0 / cuts, reach_ / travel) : 1.0 / cuts;
    const double next = at + part > 1 - 1e-9 ? 1 : at + part;
    const Pose end = pose_between(start, target, next);
    const double piece = sweeper_.travel(end), free = free_part(end, touch, result);
    const bool made = advance(end, free, result, Guarded::Part) >= 1;
    reach_ = made ? reach_ * kTryGrowth : std::max(kMinTry * tolerance, 2 * free * piece);
    if (!made) {
      if (free == 1) result.contacts.assign(guarded_.begin(), guarded_.end());
      break;
    }
    at = next;
  }
  // All of it is on one screw.
  if (!result.way.empty()) result.way = {sweeper_.pose()};
}

double CertificateResponse::free_part(const Pose& end, bool touch, StepResult& result) {
  const double travel = sweeper_.travel(end), tolerance = sweeper_.tolerance();
  const double kept = kBackoffShare * tolerance / travel, rest = kRestShare * tolerance / travel;
  double part = 1;
  const auto stop_at = [&](const CertificateSweep& found) {
    stopping_ = found.blocked;
    if (found.free) return;
    report(found, result);
    part = touch ? part * found.toi - kept : 0;
    // What is as good as at its contact already stays: every sweep of so little costs as much as one of a lot.
    if (part < rest) part = 0;
  };
  stop_at(sweeper_.sweep_pairs(stopping_, end, kContactWindow));
  // Some of what blocks shorten the motion well enough for all the rest to be looked at.
  for (const Effort effort : {Effort::Some, Effort::Full}) {
    if (part == 0) break;
    const Pose stop = part < 1 ? pose_between(sweeper_.pose(), end, part) : end;
    const CertificateSweep found = sweep(stop, kContactWindow, effort, result);
    if (found.free) {
      if (part == 1) result.clearance = found.clearance;
      break;
    }
    result.clearance = 0;
    stop_at(found);
    if (found.complete) break;
  }
  return part;
}

void CertificateResponse::slide(const Pose& target, StepResult& result) {
  const double tolerance = sweeper_.tolerance(), rest = kRestShare * tolerance;
  const double lever = std::max(sweeper_.radius() / 2, tolerance);
  contacts_.drop_vertices();
  bool fresh = contacts_.empty();  // the contacts' axes are those of the motion that is wanted from here
  bool found_here = fresh;         // all contacts were found where the set is
  bool on_course = false;          // the last motion was on the screw to the target
  Effort effort = Effort::Fits;    // while what it tells is new
  for (int tries = 0; tries < kMaxTries;) {
    const SlideContacts::Twist wanted = twist_to(target);
    const SlideContacts::Twist tried = shortened(wanted, reach_);
    const bool whole = travel_of(tried) >= travel_of(wanted);
    if (!std::exchange(fresh, true)) contacts_.choose_axes(within_arcs(whole ? target : twisted(tried)));
    const SlideContacts::Twist allowed = contacts_.nearest(tried, lever), twist = bent_little(allowed);
    const double travel = travel_of(twist);
    const bool creeping = twist.bounded && travel_of(allowed) < kCreepShare * travel_of(tried);
    if (!found_here && (travel < rest || creeping) && look_again()) {
      // Of many pairs one that was left behind may be what holds the set.
      contacts_.drop_pairs();
      fresh = found_here = true;
      ++tries;
      continue;
    }
    if (travel < rest || (creeping && !result.way.empty())) break;

    const Pose end = within_arcs(twist.bounded || !whole ? twisted(twist) : target);
    const CertificateSweep found =
        sweep(end, std::max(kContactWindow, kContactReach * tolerance / travel), effort, result);
    result.clearance = found.clearance;
    if (!found.free) report(found, result);
    tries += !found.free || twist.bounded;
    if (found.free) {
      bool made = advance(end, 1, result, Guarded::Whole) > 0;
      if (take_guarded(result)) {
        ++tries;
        continue;
      }
      if (!made) made = advance(end, 1, result, Guarded::Part) > 0;
      const bool was_on_course = std::exchange(on_course, !twist.bounded);
      // What goes on along one screw is one motion.
      if (made && was_on_course && on_course) result.way.erase(result.way.end() - 2);
      reach_ *= kTryGrowth;
      fresh = found_here = false;
      if (made && !creeping) held_times_ = 0;
      if (!made || creeping || sweeper_.pose() == target) break;
      continue;
    }
    bool news = false;
    double part = found.toi;
    for (const BlockedPair& pair : found.blocked) {
      news |= contacts_.add(pair);
      part = std::min(part, contacts_.part_within_reserve(pair));
    }
    for (const BlockedFit& fit : found.fits) news |= contacts_.add_fit(fit);
    if (news) continue;
    if (!found.fits.empty()) {
      effort = Effort::Quick;
      continue;
    }
    if (!found.complete) {
      // Others may block before: as far as these allow, all have to be looked at.
      reach_ = part * travel;
      if (reach_ < rest) break;
      continue;
    }
    reach_ = std::max(kMinTry * tolerance, 2 * found.toi * travel);
    const bool made = advance(end, part, result, Guarded::Part) > 0;
    if (!take_guarded(result) && !made) break;
    fresh = on_course = found_here = false;
    if (made && !creeping) held_times_ = 0;
  }
  end_slide(target, result);
}

bool CertificateResponse::look_again() {
  ++held_times_;
  return held_times_ <= kAlwaysLookAgain || (held_times_ & (held_times_ - 1)) == 0;
}

void CertificateResponse::end_slide(const Pose& target, StepResult& result) {
  const double left = sweeper_.travel(target), tolerance = sweeper_.tolerance();
  if (left > 0 && left <= contacts_.withheld()) {
    const CertificateSweep found = sweep(target, kContactWindow, Effort::Quick, result);
    if (found.free && advance(target, 1, result, Guarded::Whole) > 0)
      result.clearance = std::min(result.clearance, found.clearance);
  }
  contacts_.drop_beyond(kContactReach * tolerance);
  result.touching = contacts_.points(tolerance);
  // What a cylinder is held by was not told by any triangles.
  if (!result.contacts.empty()) return;
  for (const ContactPoint& c : result.touching) result.contacts.push_back(contact_of(c, 0));
}

bool CertificateResponse::take_guarded(StepResult& result) {
  if (guarded_.empty()) return false;
  result.contacts.assign(guarded_.begin(), guarded_.end());
  bool news = false;
  for (const VertexContact& c : guarded_) {
    const bool a_moves = sweeper_.holds(c.a);
    BlockedPair pair{
        a_moves ? c.a : c.b, a_moves ? c.b : c.a, a_moves ? c.face_a : c.face_b, a_moves ? c.face_b : c.face_a, 0, {}};
    // Out of the face that the vertex is behind.
    const bool moving_is_outer = c.a_is_outer == a_moves;
    const ComponentId outer = moving_is_outer ? pair.moving : pair.fixed;
    const FaceId face = moving_is_outer ? pair.face_moving : pair.face_fixed;
    const Vec3 out = normalized(normal_unscaled(sweeper_.solid(outer).triangle(face.value)));
    const Mat3 seen = mat3_from_quat((inverse(sweeper_.poses()[pair.fixed.value]) * sweeper_.pose()).rotation);
    pair.axis = moving_is_outer ? seen * out : -out;
    news |= contacts_.add_vertex(pair);
  }
  guarded_.clear();
  return news;
}

SlideContacts::Twist CertificateResponse::bent_little(SlideContacts::Twist twist) const {
  const double bend = sweeper_.radius() * length_squared(twist.rotation) / 2;
  const double most = kBendShare * sweeper_.tolerance();
  if (!twist.bounded || bend <= most) return twist;
  const double scale = std::sqrt(most / bend);
  return {scale * twist.velocity, scale * twist.rotation, true};
}

Pose CertificateResponse::within_arcs(const Pose& target) const {
  const double deviation = sweeper_.deviation(target);
  const double most = kArcShare * sweeper_.tolerance();
  return deviation <= most ? target : pose_between(sweeper_.pose(), target, std::sqrt(most / deviation) * (1 - 1e-6));
}

SlideContacts::Twist CertificateResponse::twist_to(const Pose& target) const {
  const Screw screw = screw_between(sweeper_.pose(), target);
  const Vec3 turn = screw.angle * screw.axis;
  return {screw.velocity + cross(turn, sweeper_.center() - screw.reference), turn, false};
}

double CertificateResponse::travel_of(const SlideContacts::Twist& twist) const {
  return length(twist.velocity) + sweeper_.radius() * length(twist.rotation);
}

SlideContacts::Twist CertificateResponse::shortened(SlideContacts::Twist twist, double max_travel) const {
  const double travel = travel_of(twist);
  if (travel <= max_travel) return twist;
  const double scale = max_travel / travel;
  return {scale * twist.velocity, scale * twist.rotation, twist.bounded};
}

Pose CertificateResponse::twisted(const SlideContacts::Twist& twist) const {
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

void CertificateResponse::begin() {
  contacts_.clear();
  stopping_.clear();
  held_times_ = 0;
  reach_ = std::numeric_limits<double>::infinity();
}

void CertificateResponse::jump(Span<const Pose> poses) {
  sweeper_.jump(poses);
  guard_.jump();
  embedded_.jump(poses);
  adopt_parted();
  begin();
}

}  // namespace dismantle
