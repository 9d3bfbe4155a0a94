// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/response/certificate_response.h"

#include "dismantle/certificates/response/slide_state.h"
#include "dismantle/core/contract.h"
#include "dismantle/engine/chords.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace dismantle {

namespace {

using Clock = std::chrono::steady_clock;

/// A motion that was shortened this many times and is still blocked is not made.
constexpr int kMaxShortenings = 6;
/// After so many steps of a set that hardly moved, a depth that is not bounded yet counts as too deep.
constexpr int kMaxUndecidedSteps = 150;
/// After so many unfinished steps of such a set, its step is finished: contacts may keep each other from being used.
constexpr int kMaxUnfinishedSteps = 250;

}  // namespace

CertificateResponse::CertificateResponse(CertificateSweeper& sweeper)
    : sweeper_(sweeper), contacts_(sweeper), reach_(std::numeric_limits<double>::infinity()) {}

StepResult CertificateResponse::step(const Pose& target, ResponseKind response) {
  const Pose goal{target.position, nearer_to(sweeper_.pose().rotation, target.rotation)};
  const Clock::time_point start = Clock::now();
  StepResult result;
  sweeper_.begin_step(goal);
  unfinished_ = undecided_ = false;
  result.pose = sweeper_.pose();
  if (undecided_steps_ == 0 && unfinished_steps_ == 0) resting_ = result.pose;
  if (result.pose == goal) {
    result.reached = true;
  } else if (response == ResponseKind::Slide) {
    slide(goal, result);
  } else {
    go(goal, response == ResponseKind::Touch, result);
  }
  sweeper_.end_step();
  const bool has_moved = sweeper_.motion_to(resting_).path_length > sweeper_.tolerance();
  undecided_steps_ = has_moved ? 0 : undecided_steps_ + (undecided_ ? 1 : 0);
  unfinished_ |= undecided_;
  unfinished_steps_ = has_moved || !unfinished_ ? 0 : unfinished_steps_ + 1;
  unfinished_ &= unfinished_steps_ <= kMaxUnfinishedSteps;
  result.pose = sweeper_.pose();
  result.reached = result.pose == goal;
  result.unfinished = unfinished_ && !result.reached;
  if (result.reached) result.blocking_pairs.clear();
  result.cost.overlapping_pairs = sweeper_.overlapping_count();
  result.cost.ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return result;
}

CertificateSweep CertificateResponse::sweep(const ScrewMotion& motion, double window, SweepBudget budget,
                                            StepResult& result) {
  CertificateSweep found = sweeper_.sweep(motion, window, budget);
  sweeper_.count_work(found);
  unfinished_ |= found.cut;
  undecided_ |= found.undecided && undecided_steps_ < kMaxUndecidedSteps;
  ++result.sweeps;
  result.cost.pairs = found.front;
  result.cost.node_pairs += found.node_pairs;
  result.cost.triangle_pairs += found.triangle_tests;
  result.cost.tests += found.triangle_tests;
  result.cost.depth_tests += found.depth_tests;
  result.cost.device_tests += found.device_tests;
  return found;
}

void CertificateResponse::advance(const ScrewMotion& motion, double fraction, StepResult& result) {
  if (!(fraction > 0)) return;
  sweeper_.move_to(motion.at(fraction));
  sweeper_.part_others();
  result.poses.push_back(sweeper_.pose());
}

void CertificateResponse::report(const CertificateSweep& sweep, StepResult& result) const {
  result.blocking_pairs.clear();
  for (const SweepContact& b : sweep.blocked) {
    if (b.toi > sweep.toi + kContactWindow) continue;
    const BlockingPair pair = blocking_pair_of(b, b.toi);
    // Two faces may be blocked by the ghosts of each other.
    const auto same = [&](const BlockingPair& known) {
      return known.a == pair.a && known.b == pair.b && known.face_a == pair.face_a && known.face_b == pair.face_b;
    };
    const auto known = std::find_if(result.blocking_pairs.begin(), result.blocking_pairs.end(), same);
    if (known == result.blocking_pairs.end()) {
      result.blocking_pairs.push_back(pair);
    } else {
      known->toi = std::min(known->toi, pair.toi);
    }
  }
}

void CertificateResponse::go(const Pose& target, bool touch, StepResult& result) {
  const ScrewMotion whole = sweeper_.motion_to(target);
  const double tolerance = sweeper_.tolerance();
  const int cuts = chord_count(whole.deviation, kArcShare * tolerance);
  for (double at = 0; at < 1;) {
    if (touch && at > 0 && sweeper_.is_used_up()) {
      unfinished_ = true;
      break;
    }
    // Touch, once stopped, tries short motions first: triangles behind a contact cost most.
    const double fraction = touch ? std::min(1.0 / cuts, reach_ / whole.path_length) : 1.0 / cuts;
    const double next = at + fraction > 1 - 1e-9 ? 1 : at + fraction;
    const ScrewMotion motion = sweeper_.motion_to(whole.at(next));
    const double free = free_fraction(motion, touch, result);
    advance(motion, free, result);
    reach_ = free == 1 ? reach_ * kTryGrowth : std::max(kMinTry * tolerance, 2 * free * motion.path_length);
    if (free < 1) {
      // Stop is all or nothing, also where the first parts of a rotation were free.
      if (!touch && at > 0) {
        sweeper_.return_to(whole.start);
        result.poses.clear();
      }
      break;
    }
    at = next;
  }
  // All of it is on one screw.
  if (!result.poses.empty()) result.poses = {sweeper_.pose()};
}

double CertificateResponse::free_fraction(const ScrewMotion& motion, bool touch, StepResult& result) {
  const double travel = motion.path_length, tolerance = sweeper_.tolerance();
  const double kept = kBackoffShare * tolerance / travel, rest = kRestShare * tolerance / travel;
  double fraction = 1;
  const auto stop_at = [&](const CertificateSweep& found) {
    stopping_ = found.blocked;
    if (found.free) return;
    report(found, result);
    fraction = touch ? fraction * found.toi - kept : 0;
    // A set that is practically at its contact stays: a sweep of so short a motion costs as much as one of a long one.
    if (fraction < rest) fraction = 0;
  };
  stop_at(sweeper_.sweep_pairs(stopping_, motion, kContactWindow));
  // A sample of the blocked pairs shortens the motion enough for all others to be swept. Where a sweep shortens a
  // rotation, the pose reached is not on the chords that were swept: the shorter motion is swept again.
  for (int tries = 0; fraction > 0; ++tries) {
    const ScrewMotion trial = fraction < 1 ? sweeper_.motion_to(motion.at(fraction)) : motion;
    const SweepBudget budget = tries == 0 ? SweepBudget::Sampled : SweepBudget::Exhaustive;
    const CertificateSweep found = sweep(trial, kContactWindow, budget, result);
    if (found.free) {
      if (fraction == 1) result.clearance = found.clearance;
      break;
    }
    result.clearance = 0;
    if (undecided_ || found.cut) return 0;
    stop_at(found);
    if (found.complete && trial.deviation == 0) break;
    if (tries == kMaxShortenings) fraction = 0;
  }
  return fraction;
}

void CertificateResponse::begin() {
  contacts_.clear();
  stopping_.clear();
  hardly_moved_ = 0;
  unfinished_ = keeps_axes_ = false;
  undecided_steps_ = unfinished_steps_ = 0;
  reach_ = std::numeric_limits<double>::infinity();
}

void CertificateResponse::jump(Span<const Pose> poses) {
  sweeper_.jump(poses);
  begin();
}

}  // namespace dismantle
