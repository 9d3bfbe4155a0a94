// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/screw.h"

namespace dismantle::audit {

/// A screw motion of body b in the frame of body a: x_a(s) = at(s) * x_b for s in [0, 1]. The twist is constant, so
/// that the velocity of a point depends on its position alone.
struct RelativeMotion {
  RigidTransform start;  ///< Pose of b at s = 0.
  Screw screw;           ///< In the frame of a; its reference is the origin.

  /// Pose of b at the time s.
  RigidTransform at(double s) const;
  /// Velocity of the point of b that is at `x_a` [mm per unit of s].
  Vec3 velocity(Vec3 x_a) const { return screw.velocity + cross(screw.angle * screw.axis, x_a); }
  /// Magnitude of the acceleration, which is constant and towards the axis, of a point with velocity `v` [mm per unit
  /// of s squared].
  double acceleration(Vec3 v) const { return screw.angle * length(v - dot(v, screw.axis) * screw.axis); }
  /// True if b does not move.
  bool still() const { return screw.angle == 0 && screw.velocity == Vec3{}; }
};

/// The motion of b relative to a stationary a. @param world_from_a, world_from_b poses of the bodies' frames, that of b
/// at the start @param world_screw of b in the world
RelativeMotion relative_motion(const RigidTransform& world_from_a, const RigidTransform& world_from_b,
                               const Screw& world_screw);

/// The motion of a in the frame of b.
RelativeMotion reversed_roles(const RelativeMotion& motion);

}  // namespace dismantle::audit
