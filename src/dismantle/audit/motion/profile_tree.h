// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/motion/helical_motion.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// An interval [low, low + width] on a circle, or on a line (circumference 0). On a circle `low` is in
/// [0, circumference), and a width of the circumference is the whole circle.
struct Arc {
  double low = 0;     ///< Begin.
  double width = -1;  ///< Length; negative for the empty arc.

  ///@{ End and middle, on a circle perhaps beyond the circumference.
  double high() const { return low + width; }
  double middle() const { return low + width / 2; }
  ///@}
};

/// The arc from `low` to `high`.
Arc make_arc(double low, double high, double circumference);
/// The smallest arc that contains two arcs; either may be empty.
Arc united(const Arc& p, const Arc& q, double circumference);
/// The smallest gap between two arcs, in either direction; negative where they overlap.
double gap(const Arc& p, const Arc& q, double circumference);

/// Directions in the profile plane of a helical motion. With r the distance from the axis, theta the angle about it and
/// z the position along it, the motion changes neither r nor the helix phase u = z - pitch * theta, which is defined up
/// to whole turns. In the plane of r and u, all turns of a thread coincide in one profile, independent of
/// theta.
struct ProfileFrame {
  static constexpr int kDirections = 8;  ///< Number of directions.
  ///@{ Coordinates of the directions in the plane of r and u; the first is that of r.
  std::array<double, kDirections> of_r, of_u;
  ///@}
  std::array<double, kDirections> circumference;  ///< Period along each direction [mm]; 0 where there is none.
  double pitch = 0;                               ///< Of the motion [mm per rad].

  /// @param angles of the other directions, from r towards u, in (0, pi)
  ProfileFrame(double pitch, const std::array<double, kDirections - 1>& angles);
  /// Bound of the difference of two points' coordinates along direction k, for points within `distance` of each other
  /// and at least `radius` from the axis [mm].
  double max_difference(int k, double distance, double radius) const;
};

/// The frame with the most frequent normal directions of the surfaces of b, and of a at the same distances from the
/// axis: for a thread, the directions perpendicular to its flanks.
ProfileFrame profile_frame(const PairMotion& pair, const HelicalMotion& motion);

/// A node of a ProfileTree, depth first: the left child is the next node.
struct ProfileNode {
  ///@{ Distances from the axis and positions along it [mm].
  Arc r, z;
  ///@}
  Arc theta;                                         ///< Angles about the axis [rad].
  std::array<Arc, ProfileFrame::kDirections> along;  ///< Coordinates along the frame's directions [mm].
  std::uint32_t right = 0;                           ///< Index of the right child; 0 for a leaf.
  std::uint32_t face = 0;                            ///< Face of a leaf.
  /// True for a leaf.
  bool leaf() const { return right == 0; }
};

/// A tree over triangles for one helical motion: divided first by normal and position in the profile, so
/// that a flank of a thread is one node, then by position along and about the axis.
class ProfileTree {
 public:
  /// @param triangles at the begin of the motion, in its frame (of a); a leaf's `face` is an index in them. @pre not
  /// empty
  ProfileTree(const std::vector<Triangle>& triangles, const HelicalMotion& motion, const ProfileFrame& frame);
  /// A node; 0 is the root.
  const ProfileNode& node(std::uint32_t i) const { return nodes_[i]; }

 private:
  struct Builder;
  std::vector<ProfileNode> nodes_;
};

}  // namespace dismantle::audit
