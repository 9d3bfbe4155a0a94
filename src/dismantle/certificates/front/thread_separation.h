// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/thread_bounds.h"
#include "dismantle/certificates/front/radial_separation.h"

#include <memory>
#include <vector>

namespace dismantle {

/// Mating threads of two components, an external and an internal one: the nodes of both trees in one thread's
/// coordinates.
struct ThreadMatch {
  /// The thread of one component.
  struct Side {
    Vec3 point;              ///< A point of the axis, relative to the tree's origin [mm].
    Vec3 direction;          ///< Unit, along the axis.
    Vec3 first;              ///< Unit, across the axis: the direction of angle 0.
    ThreadBoundsList nodes;  ///< Bounds of the tree's nodes.
  };
  ThreadFrame frame;  ///< Lead, period and profile directions of both; the axis is that of the first side.
  Side sides[2];      ///< Of A and of B.
};

/// The threads of A that mate with threads of B about nearly the same axis in the assembled state.
/// @param origin_a, origin_b origins of the trees [mm, assembled]
std::vector<ThreadMatch> match_threads(const RevolutionSurface& a, Vec3 origin_a, const RevolutionSurface& b,
                                       Vec3 origin_b);

/// Separation of a screw from the nut that it turns in: two threads are apart as long as their profiles are, which a
/// motion along the thread does not change. One test separates a flank of the whole bolt from one of the whole nut.
///
/// The helix phase of a point is its axial position less the lead for each turn of its angle (ThreadFrame).
///
/// Proof: the coordinate of (distance, phase) along a direction of their plane is a function of the point whose
/// gradient, at a distance r from the axis, has the length L(r) = sqrt(radial^2 + axial^2 (1 + (lead / 2 pi r)^2)).
/// Points whose values differ by g, whatever whole number of periods is added to the phase of one, are thus at least
/// g / L apart, with L at the smallest distance from the axis on the segment between them. A motion along the thread of
/// coincident axes keeps both coordinates; the true motion deviates from it by the offset of the axes at the start, and
/// by at most the difference of the two motions' velocities anywhere on the path.
class ThreadSweep {
 public:
  /// @param moving index of the side of the match that moves
  ThreadSweep(const ThreadMatch& match, int moving, const PairMotion& motion);

  /// False if the axes are too far apart for any gap to be proved.
  bool useful() const { return useful_; }
  ///@{ Prefetch the memory of two nodes: first their slots, some calls later the nodes.
  void prefetch_slots(std::uint32_t moving, std::uint32_t fixed) const {
    match_->sides[moving_].nodes.prefetch_slot(moving);
    match_->sides[1 - moving_].nodes.prefetch_slot(fixed);
  }
  void prefetch(std::uint32_t moving, std::uint32_t fixed) const {
    match_->sides[moving_].nodes.prefetch(moving);
    match_->sides[1 - moving_].nodes.prefetch(fixed);
  }
  ///@}
  /// A gap of two nodes.
  struct Gap {
    double during;    ///< Lower bound of the distance of their triangles during the motion [mm].
    double in_place;  ///< The same for a motion along the thread with the axes in one, in this phase [mm].
  };
  /// The gap of two nodes' triangles; minus infinity if nothing is known.
  Gap gap(std::uint32_t moving, std::uint32_t fixed) const;

  /// Lower bound of the distance of two nodes during this motion [mm], from the gap in place that an earlier motion
  /// with its phase found: a gap in place changes by no more than the phase does.
  double kept_gap(float in_place, float phase) const;
  /// Phase of the moving thread in the fixed one, within half a period of 0 [mm].
  double phase() const;
  /// The match.
  const ThreadMatch& match() const { return *match_; }

 private:
  /// Upper bound of how far points of the node deviate from the motion along the thread [mm].
  double off(const ThreadBounds& node) const;

  const ThreadMatch* match_;
  int moving_;
  double phase_ = 0;        ///< To be added to helix phases of the moving side [mm].
  Vec3 across_;             ///< From the fixed axis to the point of the moving one [mm].
  Vec3 tilt_;               ///< Direction of the moving axis minus that of the fixed one.
  double turning_ = 0;      ///< Length of the difference of the two motions' rotations [rad].
  double sliding_ = 0;      ///< Length of the difference of their velocities, at the moving axis' point [mm].
  double angle_ = 0;        ///< Rotation of the true motion [rad],
  double speed_ = 0;        ///< and its velocity at that point [mm].
  double largest_off_ = 0;  ///< The largest off() of a bounded node of the moving side [mm]; infinite: none is.
  bool useful_ = false;
};

}  // namespace dismantle
