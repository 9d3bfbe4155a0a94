// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"

namespace dismantle {

/// The one screw motion (constant twist, rotation angle at most pi) that takes a body from pose `start` to pose `end`.
/// It is kept as the twist at a reference point, not as an axis in space: a nearly pure translation has its axis
/// almost at infinity, where coordinates lose all their digits. World frame; lengths in mm, angles in rad.
struct Screw {
  Vec3 reference;    ///< The point that the twist is given at: where the assembly's origin is at s = 0.
  Vec3 velocity;     ///< Velocity of the reference point at s = 0 [mm per unit of s].
  Vec3 axis;         ///< Unit direction of the rotation axis; zero where nothing rotates.
  double angle = 0;  ///< Rotation over the whole motion, in [0, pi].
};

/// The screw from pose `start` to pose `end`. Below kScrewMinimumAngle a rotation counts as none: its arc over a lever
/// of 1e5 mm is under 1e-7 mm. The two poses' rotations may have either sign.
Screw screw_between(const Pose& start, const Pose& end);

/// Rotations under this angle [rad] are treated by screw_between as pure translation.
inline constexpr double kScrewMinimumAngle = 1e-12;

/// The rigid motion that the screw has made at time `s`, to be applied after the start pose: x(s) = screw_at(screw, s)
/// * x(0).
Pose screw_at(const Screw& screw, double s);

/// The pose at time `s` of a body that goes by the one screw from `start` to `end`; exactly `start` at 0 and `end`
/// at 1.
Pose pose_between(const Pose& start, const Pose& end, double s);

/// A point on the rotation axis. @pre screw.angle > 0
Vec3 screw_axis_point(const Screw& screw);

/// The largest distance from the screw's axis that a point of the sphere (center, radius) has; 0 where nothing rotates
/// [mm].
double screw_radius(const Screw& screw, Vec3 center, double radius);

/// An upper bound of the path length of any point within `rho` of the axis, over the whole motion [mm].
double screw_path_length(const Screw& screw, double rho);

/// An upper bound of the distance, at equal times, between a point's arc and its chord (the linear path), for a point
/// within `rho` of the axis: rho angle^2 / 8 (docs/design/0000-overview.md) [mm].
double screw_chord_deviation(const Screw& screw, double rho);

}  // namespace dismantle
