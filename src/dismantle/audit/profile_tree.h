// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/motion/helical_motion.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// Numbers from `low` on, `width` far: on a circle, or on a line (circumference 0). On a circle `low` is in
/// [0, circumference), and a width of the circumference means all of it.
struct Arc {
  double low = 0, width = -1;  // nothing

  double high() const { return low + width; }
  double middle() const { return low + width / 2; }
};

/// The arc from `low` to `high`.
Arc make_arc(double low, double high, double circumference);
/// The least arc that holds two; either may hold nothing.
Arc united(const Arc& p, const Arc& q, double circumference);
/// The least gap between two arcs, either way round; negative where they overlap.
double gap(const Arc& p, const Arc& q, double circumference);

/// How a helical motion sees the space around its axis. With r the distance from the axis, theta the angle about it and
/// z the place along it, the motion changes neither r nor the lift u = z - pitch * theta, which is given up to whole
/// turns. In the plane of r and u a thread is one profile, however many turns it has and however far it is turned.
struct ProfileFrame {
  static constexpr int kDirections = 8;
  /// Coordinates of directions in the plane of r and u; the first is that of r.
  std::array<double, kDirections> of_r, of_u;
  std::array<double, kDirections> circumference;  ///< What a turn is along them [mm]; 0 where nothing repeats.
  double pitch = 0;

  /// @param angles of the other directions, from r towards u, in (0, pi)
  ProfileFrame(double pitch, const std::array<double, kDirections - 1>& angles);
  /// Places along direction k of points nearer to each other than `distance` differ by at most this much, where r is at
  /// least `radius` for both.
  double spread(int k, double distance, double radius) const;
};

/// The frame with the directions in which most of the surface of b, and of what a has at the same distances from the
/// axis, faces: of a thread those across its flanks.
ProfileFrame profile_frame(const PairSweep& pair, const HelicalMotion& motion);

/// A node of a ProfileTree, depth first: the left child is the next node.
struct ProfileNode {
  Arc r, z;                                          ///< On lines [mm].
  Arc theta;                                         ///< On the circle [rad].
  std::array<Arc, ProfileFrame::kDirections> along;  ///< Places along the frame's directions [mm].
  std::uint32_t right = 0;                           ///< The right child; 0 in a leaf.
  std::uint32_t face = 0;                            ///< The triangle of a leaf.
  bool leaf() const { return right == 0; }
};

/// The triangles of a body under a tree for one helical motion: first what faces the same way in the profile and lies
/// at the same place of it, so that a flank of a thread is one node, then by places along and about the axis.
class ProfileTree {
 public:
  /// @param motion as it is seen from the frame in which `a_from_body` puts the body
  ProfileTree(const AuditBody& body, const RigidTransform& a_from_body, const HelicalMotion& motion,
              const ProfileFrame& frame);
  const ProfileNode& node(std::uint32_t i) const { return nodes_[i]; }

 private:
  struct Builder;
  std::vector<ProfileNode> nodes_;
};

}  // namespace dismantle::audit
