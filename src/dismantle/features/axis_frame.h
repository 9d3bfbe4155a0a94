// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

/// A frame for cylindrical coordinates about an axis.
struct AxisFrame {
  Vec3 point;      ///< On the axis, where `along` is 0 [mm].
  Vec3 direction;  ///< Of the axis; unit.
  Vec3 first;      ///< Across the axis, at angle 0; unit.
  Vec3 second;     ///< Across the axis, at a quarter turn; unit. (first, second, direction) is right-handed.

  AxisFrame() = default;
  /// The frame of an axis; where angle 0 is depends on its direction only.
  /// @param axis_point any point of the axis [mm]
  /// @param axis_direction unit
  AxisFrame(Vec3 axis_point, Vec3 axis_direction) : point(axis_point), direction(axis_direction) {
    const Vec3 other = std::abs(direction.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    first = normalized(cross(direction, other));
    second = cross(direction, first);
  }

  /// The position along the axis, from `point` [mm].
  double along(Vec3 p) const { return dot(p - point, direction); }
  /// The vector from the axis to the point, perpendicular to the axis [mm].
  Vec3 across(Vec3 p) const {
    const Vec3 from = p - point;
    return from - dot(from, direction) * direction;
  }
  /// The angle of a vector perpendicular to the axis, in (-pi, pi].
  double angle(Vec3 v) const { return std::atan2(dot(v, second), dot(v, first)); }
  /// The distance from the axis of a segment, in the projection along the axis [mm].
  /// @param a, b its ends as across() gives them
  static double distance_of_segment(Vec3 a, Vec3 b) {
    const Vec3 along = b - a;
    const double square = length_squared(along);
    const double t = square > 0 ? std::clamp(-dot(a, along) / square, 0.0, 1.0) : 0;
    return length(a + t * along);
  }
  /// The unit vector perpendicular to the axis at an angle [rad].
  Vec3 at(double angle) const { return std::cos(angle) * first + std::sin(angle) * second; }
};

}  // namespace dismantle
