// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

#include <cmath>

namespace dismantle {

/// Directions that no CAD model is aligned with.
inline constexpr Vec3 kRayDirections[] = {
    {0.5318, 0.3177, 0.7850},  {-0.4129, 0.8231, 0.3899},  {0.6972, -0.2213, -0.6819}, {-0.2891, -0.6173, 0.7317},
    {0.1733, 0.9411, -0.2903}, {-0.8839, 0.1291, -0.4495}, {0.3571, -0.7919, 0.4953},  {-0.6143, -0.4337, -0.6591}};

/// Relative size below which a side of a ray cannot be told from rounding.
inline constexpr double kRaySideError = 1e-12;

enum class RayHit { Miss, Hit, Unclear };

namespace detail {

/// On which side of the ray from the origin along `d` the segment a-b passes, scaled; 0 where it cannot be told.
inline double ray_side(Vec3 d, Vec3 a, Vec3 b) {
  const double value = dot(d, cross(a, b));
  return std::abs(value) <= kRaySideError * norm_one(a) * norm_one(b) ? 0 : value;
}

}  // namespace detail

/// Crosses the ray from the origin along `d` the triangle?
inline RayHit ray_hit(Vec3 d, const Triangle& t) {
  const double ab = detail::ray_side(d, t[0], t[1]), bc = detail::ray_side(d, t[1], t[2]),
               ca = detail::ray_side(d, t[2], t[0]);
  const bool some_right = ab < 0 || bc < 0 || ca<0, some_left = ab> 0 || bc > 0 || ca > 0;
  if (some_right && some_left) return RayHit::Miss;
  if (ab == 0 || bc == 0 || ca == 0) return RayHit::Unclear;
  // The line crosses; before or behind the origin, by the sign of the triangle's plane.
  const Vec3 n = normal_unscaled(t);
  const double height = dot(n, t[0]), slope = dot(n, d);
  if (std::abs(height) <= kRaySideError * norm_one(n) * norm_one(t[0]) || slope == 0) return RayHit::Unclear;
  return (height > 0) == (slope > 0) ? RayHit::Hit : RayHit::Miss;
}

}  // namespace dismantle
