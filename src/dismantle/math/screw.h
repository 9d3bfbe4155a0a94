// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"

namespace dismantle {

/// A screw motion (constant twist, rotation angle at most pi) over the time s from 0 to 1. It is kept as the twist at a
/// reference point, not as an axis in space: the axis of a nearly pure translation is almost at infinity, where
/// coordinates lose all their digits. World frame.
struct Screw {
  Vec3 reference;    ///< Point that the twist refers to: the position of the assembly's origin at s = 0 [mm].
  Vec3 velocity;     ///< Of the reference point at s = 0 [mm per unit of s].
  Vec3 axis;         ///< Unit direction of the rotation axis; zero for a translation.
  double angle = 0;  ///< Rotation over the whole motion, in [0, pi] [rad].
};

/// The screw motion that takes a body from pose `start` to pose `end`. Rotations below kScrewMinimumAngle count as
/// none: their arc at a radius of 1e5 mm is below 1e-7 mm. The signs of the rotations' quaternions do not matter.
Screw screw_between(const Pose& start, const Pose& end);

/// Rotations below this angle are treated by screw_between as pure translation [rad].
inline constexpr double kScrewMinimumAngle = 1e-12;

/// The rigid motion of the screw up to time `s`, to be applied after the start pose: x(s) = screw_at(screw, s) * x(0).
Pose screw_at(const Screw& screw, double s);

/// The pose at time `s` of a body that moves along the screw from `start` to `end`; exactly `start` at 0 and `end`
/// at 1.
Pose pose_between(const Pose& start, const Pose& end, double s);

/// A point on the rotation axis. @pre screw.angle > 0
Vec3 screw_axis_point(const Screw& screw);

/// The largest distance of a point of the sphere (center, radius) from the screw's axis [mm]; 0 for a translation.
double screw_radius(const Screw& screw, Vec3 center, double radius);

/// An upper bound of the path length over the whole motion of any point within `rho` [mm] of the axis [mm].
double screw_path_length(const Screw& screw, double rho);

/// An upper bound of the distance, at equal times, between a point's arc and its chord (the linear path), for any point
/// within `rho` [mm] of the axis: rho angle^2 / 8 (docs/design/0000-overview.md) [mm].
double screw_chord_deviation(const Screw& screw, double rho);

/// The motion of a rigid body from one pose to another by one screw, with bounds for all its points: made once by
/// screw_motion(), so that these are not computed again for everyone who needs them.
struct ScrewMotion {
  Pose start;              ///< Pose at s = 0 [mm, world].
  Pose end;                ///< Pose at s = 1.
  Screw screw;             ///< As screw_between(start, end).
  double deviation = 0;    ///< Upper bound of the distance between any point's arc and its chord at equal times [mm].
  double path_length = 0;  ///< Upper bound of the path length of any point [mm].

  /// The pose at time `s`, as pose_between(start, end, s).
  Pose at(double s) const;
};

/// The motion of a body that lies inside a sphere.
/// @param center, radius the sphere, with the body at `start` [mm, world]
ScrewMotion screw_motion(const Pose& start, const Pose& end, Vec3 center, double radius);

}  // namespace dismantle
