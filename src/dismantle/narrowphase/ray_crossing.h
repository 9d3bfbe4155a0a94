// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

#include <cmath>
#include <optional>

namespace dismantle {

/// Directions of rays, none of which a CAD model is likely to be aligned with.
inline constexpr Vec3 kRayDirections[] = {
    {0.5318, 0.3177, 0.7850},  {-0.4129, 0.8231, 0.3899},  {0.6972, -0.2213, -0.6819}, {-0.2891, -0.6173, 0.7317},
    {0.1733, 0.9411, -0.2903}, {-0.8839, 0.1291, -0.4495}, {0.3571, -0.7919, 0.4953},  {-0.6143, -0.4337, -0.6591}};

/// Largest relative error of the side on which a ray passes an edge.
inline constexpr double kRaySideError = 1e-12;

/// Result of ray_hit().
enum class RayHit {
  Miss,     ///< The ray misses the triangle.
  Hit,      ///< The ray crosses the triangle's interior.
  Unclear,  ///< The ray passes an edge or begins at the triangle, as near as rounding can tell.
};

namespace detail {

/// The side of the ray from the origin along `d` on which the segment a-b passes, scaled; 0 where rounding hides it.
inline double ray_side(Vec3 d, Vec3 a, Vec3 b) {
  const double value = dot(d, cross(a, b));
  return std::abs(value) <= kRaySideError * norm_one(a) * norm_one(b) ? 0 : value;
}

}  // namespace detail

/// Tests the ray from the origin along `d` against a triangle; Miss and Hit are certain.
inline RayHit ray_hit(Vec3 d, const Triangle& t) {
  const double ab = detail::ray_side(d, t[0], t[1]), bc = detail::ray_side(d, t[1], t[2]),
               ca = detail::ray_side(d, t[2], t[0]);
  const bool some_right = ab < 0 || bc < 0 || ca < 0;
  const bool some_left = ab > 0 || bc > 0 || ca > 0;
  if (some_right && some_left) return RayHit::Miss;
  if (ab == 0 || bc == 0 || ca == 0) return RayHit::Unclear;
  // The line crosses; before or behind the origin, by the sign of the triangle's plane.
  const Vec3 n = normal_unscaled(t);
  const double height = dot(n, t[0]), slope = dot(n, d);
  if (std::abs(height) <= kRaySideError * norm_one(n) * norm_one(t[0]) || slope == 0) return RayHit::Unclear;
  return (height > 0) == (slope > 0) ? RayHit::Hit : RayHit::Miss;
}

/// True if a point lies inside a closed surface: a ray from it crosses the surface an odd number of times. The
/// directions of kRayDirections are tried until one is decided; false where none is: then the point is on the surface,
/// as near as rounding can tell.
/// @param crosses_oddly crosses_oddly(direction) returns std::optional<bool>: true for an odd number of Hits, nothing
///   where a triangle is Unclear
template <class CrossesOddly>
bool inside_by_rays(const CrossesOddly& crosses_oddly) {
  for (const Vec3 direction : kRayDirections)
    if (const std::optional<bool> odd = crosses_oddly(direction)) return *odd;
  return false;
}

}  // namespace dismantle
