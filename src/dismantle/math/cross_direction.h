// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/orientation_exact.h"

namespace dismantle {

/// The floating-point cross product of two differences is used if it is at least this part of the product of their
/// sizes (largest coordinates): then each coordinate is off by less than 8u / kCrossFilter of the largest one (u =
/// 2^-53; 4 roundings of two terms). Smaller ones, as of nearly parallel edges, are computed exactly.
inline constexpr double kCrossFilter = 0x1p-8;

/// Bounds the error of every coordinate of cross_direction, relative to the largest one.
inline constexpr double kCrossDirectionError = 9 * 0x1p-53 / kCrossFilter;

namespace detail {

/// The power of 2^64 that scales `size` to between 2^-150 and 2^150. @pre size > 0 and finite
DISMANTLE_HOST_DEVICE inline double scale_to_moderate(double size) {
  double scale = 1;
  while (size * scale < 0x1p-150) scale *= 0x1p64;
  while (size * scale > 0x1p150) scale *= 0x1p-64;
  return scale;
}

/// A difference scaled by a power of two, exactly. @pre nothing overflows or underflows
DISMANTLE_HOST_DEVICE inline ExactDifference operator*(double s, const ExactDifference& d) {
  return {{s * d.x.high, s * d.x.low}, {s * d.y.high, s * d.y.low}, {s * d.z.high, s * d.z.low}};
}

/// (p1 - p0) x (q1 - q0) from exact arithmetic, each coordinate within 2u, scaled by some power of two; zero only if it
/// is zero.
[[gnu::noinline]] DISMANTLE_HOST_DEVICE inline Vec3 cross_exact(Vec3 p0, Vec3 p1, Vec3 q0, Vec3 q1) {
  ExactDifference u = exact_difference(p1, p0), v = exact_difference(q1, q0);
  const double size_u = max_abs(u.high()), size_v = max_abs(v.high());
  if (size_u == 0 || size_v == 0) return {};
  u = scale_to_moderate(size_u) * u;
  v = scale_to_moderate(size_v) * v;
  return {minor_exact(u.y, v.z, u.z, v.y).estimate(), minor_exact(u.z, v.x, u.x, v.z).estimate(),
          minor_exact(u.x, v.y, u.y, v.x).estimate()};
}

}  // namespace detail

/// A vector in the direction of (p1 - p0) x (q1 - q0) within kCrossDirectionError, however nearly parallel they are;
/// zero if they are parallel or one is zero. Its length is that of the product or 1 in the largest coordinate.
/// @pre coordinates are at most 1e150
DISMANTLE_HOST_DEVICE inline Vec3 cross_direction(Vec3 p0, Vec3 p1, Vec3 q0, Vec3 q1) {
  const Vec3 u = p1 - p0, v = q1 - q0;
  const Vec3 rounded = cross(u, v);
  const double sizes = max_abs(u) * max_abs(v);
  // Outside of this range squares of the result could underflow or overflow.
  if (max_abs(rounded) >= kCrossFilter * sizes && sizes > 1e-60 && sizes < 1e60) return rounded;
  const Vec3 exact = detail::cross_exact(p0, p1, q0, q1);
  const double size = max_abs(exact);
  return size > 0 ? exact / size : Vec3{};
}

}  // namespace dismantle
