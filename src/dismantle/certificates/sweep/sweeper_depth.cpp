// SPDX-License-Identifier: Apache-2.0
// Pairs of components without ghost surfaces, whose depth is bounded; and pairs that part.
#include "dismantle/certificates/sweep/certificate_sweeper.h"
#include "dismantle/certificates/sweep/sweep_tasks.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/surface/depth/swept_depth.h"
#include "dismantle/surface/solid_distance.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Contacts of depths are found to within a motion of this share of the tolerance.
constexpr double kResolution = 0.25;
/// A sweep may examine this many points and pieces, however many the others of its step have.
constexpr std::size_t kFewestTests = 150;

}  // namespace

void CertificateSweeper::sweep_depth(const SeenMotion& motion, DeepSearch search_for, CertificateSweep& result,
                                     double until, KnownDepth* known, std::size_t max_pieces) const {
  const GuardedPair pair = guarded(motion.moving, motion.fixed);
  if (pair.guard != PairGuard::Depth) return;
  if (result.undecided) {  // the set will not move: this pair's turn comes once the one before is decided
    result.complete = false;
    return;
  }
  const RigidTransform start = transform_from_pose(motion.start), end = transform_from_pose(motion.end);
  const double way = std::max(length(end.translation - start.translation), tolerance_);
  SweptPair swept{&shape(motion.moving), &shape(motion.fixed), start, end};
  swept.until = until;
  if (known) {
    swept.known_a = &(*known)[{motion.moving, motion.fixed}];
    swept.known_b = &(*known)[{motion.fixed, motion.moving}];
  }
  const std::size_t most =
      std::min(max_pieces, std::max(kFewestTests, depth_tests_left_ - std::min(depth_tests_left_, result.depth_tests)));
  const auto deep =
      first_deeper(swept, depth_limits(pair, motion.moving < motion.fixed, tolerance_), kResolution * tolerance_ / way,
                   most, options_.keep_going, search_for, &result.depth_tests);
  result.clearance = 0;
  if (!deep) return;
  result.undecided |= !deep->is_certain && most < kMaxSweptPieces;
  const Screw screw = screw_between(motion.start, motion.end);
  const Pose then = screw_at(screw, deep->time) * motion.start;
  const RigidTransform at = transform_from_pose(then);
  // DeepSearch::Any does not say until when nothing is deep: the time of its point is the best estimate.
  const double at_time = search_for == DeepSearch::Any ? deep->time : deep->free_until;
  SweepContact contact{motion.moving, motion.fixed, FaceId(deep->face_a), FaceId(deep->face_b), at_time, {}};
  const Vec3 inside = deep->of_a ? deep->point : at * deep->nearest;
  const Vec3 surface = deep->of_a ? deep->nearest : at * deep->point;
  contact.axis = normalized(inside - surface);
  contact.limit = inside;
  contact.point = inverse(at) * inside;
  result.blocked.push_back(contact);
}

void CertificateSweeper::sweep_depths(const std::vector<SeenMotion>& motions, double window, CertificateSweep& result) {
  for (const SeenMotion& motion : motions) {
    // Later contacts would be left out.
    double until = 1;
    for (const SweepContact& b : result.blocked) until = std::min(until, b.toi + window);
    sweep_depth(motion, DeepSearch::First, result, until, &known_depth_);
  }
}

void CertificateSweeper::part_swept(const std::vector<PairSweep>& pairs) {
  // Both surface pairs of two components follow each other.
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const TestedPair& tested = pairs[i].tested;
    const double needed = std::max(tolerance_, guarded(tested.moving, tested.fixed).parting);
    if (std::min(pairs[i].apart_by, pairs[i + 1].apart_by) > needed) change_parted(tested.moving, tested.fixed, true);
  }
}

void CertificateSweeper::part_others() {
  for (const ComponentId moving : moving_)
    for (const ComponentId other : guarded_of_[moving.value]) {
      const auto& [first, second] = std::minmax(moving, other);
      GuardedPair& pair = guarded_.at({first, second});
      if (pair.parted || is_moving_[other.value]) continue;
      const RigidTransform b = transform_from_pose(poses_[second.value]);
      const double gap = store_.spheres().gap(second, b, b, 0, first, poses_[first.value]);
      if (gap > std::max(tolerance_, pair.parting) ||
          (!near(first, second, pair) && none_inside(placed(first), placed(second)) &&
           usual_ghosts_apart(first, second)))
        change_parted(first, second, true);
    }
}

bool CertificateSweeper::near(ComponentId a, ComponentId b, GuardedPair& pair) const {
  const RigidTransform at_a = transform_from_pose(poses_[a.value]), at_b = transform_from_pose(poses_[b.value]);
  const SolidTree &first = solid(a), &second = solid(b);
  if (first.tree.empty() || second.tree.empty()) return false;
  const Triangle s = first.triangle(pair.near_a.value), t = second.triangle(pair.near_b.value);
  const double before =
      distance_triangle_triangle({{at_a * s[0], at_a * s[1], at_a * s[2]}}, {{at_b * t[0], at_b * t[1], at_b * t[2]}})
          .distance;
  if (before <= pair.parting) return true;
  const SolidDistance found = solid_distance({&first, at_a}, {&second, at_b}, limit_including(pair.parting));
  if (found.distance > pair.parting) return false;
  pair.near_a = found.face_a;
  pair.near_b = found.face_b;
  return true;
}

ComponentAt CertificateSweeper::placed(ComponentId c) {
  return {&solid(c), &store_.ghost(c, c), transform_from_pose(poses_[c.value]), [this, c] { return &shape(c); }};
}

bool CertificateSweeper::apart(ComponentId a, ComponentId b, double distance) {
  return further_apart(placed(a), placed(b), distance);
}

bool CertificateSweeper::usual_ghosts_apart(ComponentId a, ComponentId b) {
  return dismantle::usual_ghosts_apart(placed(a), placed(b), tolerance_);
}

void CertificateSweeper::change_parted(ComponentId a, ComponentId b, bool parted) {
  const auto known = guarded_.find(std::minmax(a, b));
  if (known == guarded_.end() || known->second.parted == parted) return;
  set_parted(a, b, parted);
  parted ? ++parted_count_ : --parted_count_;
  mark_changed(a);
}

void CertificateSweeper::mark_changed(ComponentId c) {
  if (is_changed_[c.value]) return;
  is_changed_[c.value] = true;
  changed_.push_back(c);
}

void CertificateSweeper::find_parted() {
  const std::vector<ComponentId> changed = std::move(changed_);
  changed_.clear();
  for (const ComponentId c : changed)
    for (const ComponentId other : guarded_of_[c.value]) {
      if (is_changed_[other.value] && other < c) continue;  // the other one's turn
      const auto& [first, second] = std::minmax(c, other);
      GuardedPair& pair = guarded_.at({first, second});
      const Pose &a = poses_[first.value], &b = poses_[second.value];
      if (pair.sides.both)
        pair.sides.jump(a == b, inverse(transform_from_pose(b)) * transform_from_pose(a), tolerance_);
      // A pair that has parted remains so where the ghost surfaces that all have do not meet.
      const bool parted =
          !(a == b) && (pair.parted || apart(first, second, pair.parting)) && usual_ghosts_apart(first, second);
      if (parted == pair.parted) continue;
      set_parted(first, second, parted);
      parted ? ++parted_count_ : --parted_count_;
    }
  for (const ComponentId c : changed) is_changed_[c.value] = false;
}

}  // namespace dismantle
