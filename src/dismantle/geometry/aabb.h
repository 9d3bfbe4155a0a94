// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

#include <limits>

namespace dismantle {

/// An axis-aligned bounding box [mm]; empty by default (lower > upper).
struct Aabb {
  /// The smallest coordinates.
  Vec3 lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
  /// The largest coordinates.
  Vec3 upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

  /// True if it contains no point.
  DISMANTLE_HOST_DEVICE bool empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
  /// Grows to contain a point.
  DISMANTLE_HOST_DEVICE void extend(Vec3 p) {
    lower = min(lower, p);
    upper = max(upper, p);
  }
  /// Grows to contain a box.
  DISMANTLE_HOST_DEVICE void extend(const Aabb& b) {
    lower = min(lower, b.lower);
    upper = max(upper, b.upper);
  }
  /// The middle [mm]. @pre !empty()
  DISMANTLE_HOST_DEVICE Vec3 center() const { return 0.5 * (lower + upper); }
  /// The lengths of the edges [mm]. @pre !empty()
  DISMANTLE_HOST_DEVICE Vec3 size() const { return upper - lower; }
  /// True if both corners are equal.
  friend bool operator==(const Aabb& a, const Aabb& b) { return a.lower == b.lower && a.upper == b.upper; }
};

/// The box grown by `margin` [mm] on every side.
DISMANTLE_HOST_DEVICE inline Aabb inflated(const Aabb& b, double margin) {
  const Vec3 m{margin, margin, margin};
  return {b.lower - m, b.upper + m};
}

/// True if the closed boxes have a common point.
DISMANTLE_HOST_DEVICE inline bool overlaps(const Aabb& a, const Aabb& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

/// The length of the box's diagonal [mm]; 0 for an empty box.
inline double diagonal(const Aabb& b) {
  return b.empty() ? 0 : length(b.size());
}

}  // namespace dismantle
