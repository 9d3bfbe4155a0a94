// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/thread_bounds.h"
#include "dismantle/certificates/front/radial_separation.h"

#include <memory>
#include <vector>

namespace dismantle {

/// An outer and an inner thread of two components that fit each other: their trees' nodes in one thread's coordinates.
struct ThreadMatch {
  struct Side {
    Vec3 point, direction;  ///< Of the axis, about the tree's origin [mm].
    Vec3 first;             ///< Across it, where angles are 0.
    ThreadNodes nodes;
  };
  ThreadFrame frame;  ///< Of the lead, the period and the directions; of the first side's axis.
  Side sides[2];
};

/// The threads of A that fit threads of B about nearly the same axis in the assembled state.
/// @param a, b with their trees' origins [mm, assembled]
std::vector<ThreadMatch> match_threads(const RevolutionSurface& a, Vec3 origin_a, const RevolutionSurface& b,
                                       Vec3 origin_b);

/// A certificate of a screw that turns in its nut: two threads are apart as long as their profiles are, which a motion
/// along the thread does not change. One such certificate parts a flank of the whole bolt from one of the whole nut.
///
/// Proof: (distance, lift) along a direction of their plane is a function of the place whose gradient, at a distance r
/// from the axis, has the length L(r) = sqrt(radial^2 + lift^2 (1 + (lead / 2 pi r)^2)). Points whose values differ by
/// g, whatever whole number of periods is added to the lift of one, are thus at least g / L apart, L that of the least
/// distance from the axis on the way between them. The motion from where the axes agree, along the thread, keeps both
/// coordinates; the true one is off it by how far the axes are off each other as it begins, and by at most what the two
/// motions' velocities differ anywhere on the way.
class ThreadSweep {
 public:
  /// @param moving which side of the match moves
  ThreadSweep(const ThreadMatch& match, int moving, const PairMotion& motion);

  /// Whether the axes are near enough for anything to be gained.
  bool useful() const { return useful_; }
  /// Asks for the memory of two nodes: first for where it is, a while later for itself.
  void fetch_places(std::uint32_t moving, std::uint32_t fixed) const {
    match_->sides[moving_].nodes.fetch_place(moving);
    match_->sides[1 - moving_].nodes.fetch_place(fixed);
  }
  void fetch(std::uint32_t moving, std::uint32_t fixed) const {
    match_->sides[moving_].nodes.fetch(moving);
    match_->sides[1 - moving_].nodes.fetch(fixed);
  }
  /// Two nodes' triangles are never nearer to each other than that [mm]; without bounds below where nothing is known.
  double gap(std::uint32_t moving, std::uint32_t fixed) const;

 private:
  /// How far points of the node may be off their places along the thread [mm].
  double off(const ThreadNode& node) const;

  const ThreadMatch* match_;
  int moving_;
  double lift_ = 0;               // what is to be added to lifts of the moving side [mm]
  Vec3 across_;                   // from the fixed axis to the point of the moving one
  Vec3 tilt_;                     // the moving axis' direction less the fixed one's
  double turning_ = 0;            // the length of the difference of the two motions' rotations [rad]
  double sliding_ = 0;            // and of their velocities where the moving axis' point is seen on the fixed one [mm]
  double angle_ = 0, speed_ = 0;  // of the true motion, there
  bool useful_ = false;
};

}  // namespace dismantle
