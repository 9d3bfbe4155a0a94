// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

/// Cylindrical coordinates about an axis.
struct AxisFrame {
  Vec3 point;          ///< On the axis; where `along` is 0 [mm].
  Vec3 direction;      ///< Unit.
  Vec3 first, second;  ///< Unit vectors across it, at angles 0 and a quarter turn; right-handed with `direction`.

  AxisFrame() = default;
  /// @param axis_direction unit
  AxisFrame(Vec3 axis_point, Vec3 axis_direction) : point(axis_point), direction(axis_direction) {
    const Vec3 least = std::abs(direction.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    first = normalized(cross(direction, least));
    second = cross(direction, first);
  }

  double along(Vec3 p) const { return dot(p - point, direction); }
  /// From the axis to the point, across the axis.
  Vec3 across(Vec3 p) const {
    const Vec3 from = p - point;
    return from - dot(from, direction) * direction;
  }
  /// Of a vector across the axis, in (-pi, pi].
  double angle(Vec3 v) const { return std::atan2(dot(v, second), dot(v, first)); }
  /// The least distance of a segment from the axis, seen along it; its ends as across() gives them.
  static double distance_of_segment(Vec3 a, Vec3 b) {
    const Vec3 along = b - a;
    const double square = length_squared(along);
    const double t = square > 0 ? std::clamp(-dot(a, along) / square, 0.0, 1.0) : 0;
    return length(a + t * along);
  }
  /// The unit vector across the axis of that angle.
  Vec3 at(double angle) const { return std::cos(angle) * first + std::sin(angle) * second; }
};

}  // namespace dismantle
