// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/screw.h"

namespace dismantle::audit {

/// A screw motion of body b seen from the frame of body a: x_a(s) = at(s) * x_b for s in [0, 1]. The velocity of a
/// point depends on where it is, not on when: the twist is constant.
struct RelativeMotion {
  RigidTransform start;  ///< At s = 0.
  Screw screw;           ///< In the frame of a; its reference is the origin.

  RigidTransform at(double s) const;
  /// Velocity of the point of b that is at `x_a` [mm per unit of s].
  Vec3 velocity(Vec3 x_a) const { return screw.velocity + cross(screw.angle * screw.axis, x_a); }
  /// The acceleration (towards the axis, constant) of a point with velocity `v` [mm per unit of s squared].
  double acceleration(Vec3 v) const { return screw.angle * length(v - dot(v, screw.axis) * screw.axis); }
  bool still() const { return screw.angle == 0 && screw.velocity == Vec3{}; }
};

/// The motion of b against a that stands still. `world_from_a`, `world_from_b`: from the bodies' own frames, b at the
/// start; `world_screw`: of b in the world.
RelativeMotion relative_motion(const RigidTransform& world_from_a, const RigidTransform& world_from_b,
                               const Screw& world_screw);

/// The same motion with the roles changed: a seen from the frame of b.
RelativeMotion reversed_roles(const RelativeMotion& motion);

}  // namespace dismantle::audit
