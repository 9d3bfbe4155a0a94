// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/expansion.h"
#include "dismantle/math/vec3.h"
#include "dismantle/math/wide_integer.h"

namespace dismantle {

/// A point of a coordinate plane [mm].
struct Vec2 {
  double x = 0;  ///< First coordinate.
  double y = 0;  ///< Second coordinate.
};

namespace detail {

///@{ The absolute value; of each coordinate.
DISMANTLE_HOST_DEVICE inline double magnitude(double x) {
  return x < 0 ? -x : x;
}
DISMANTLE_HOST_DEVICE inline Vec3 magnitude(Vec3 p) {
  return {magnitude(p.x), magnitude(p.y), magnitude(p.z)};
}
///@}

///@{ The range of absolute values in which expansions of degree three are exact (as for 0): the lowest bit of a
/// coordinate is at least 2^-352, of a product of three differences 2^-1056 > 2^-1074; and no product exceeds 2^905.
inline constexpr double kExpansionSmallest = 0x1p-300;
inline constexpr double kExpansionLargest = 0x1p300;
///@}

///@{ True if every coordinate is 0 or in the range of expansions.
DISMANTLE_HOST_DEVICE inline bool in_expansion_range(double x) {
  const double size = magnitude(x);
  return size == 0 || (size >= kExpansionSmallest && size <= kExpansionLargest);
}
DISMANTLE_HOST_DEVICE inline bool in_expansion_range(Vec2 p) {
  return in_expansion_range(p.x) && in_expansion_range(p.y);
}
DISMANTLE_HOST_DEVICE inline bool in_expansion_range(Vec3 p) {
  return in_expansion_range(p.x) && in_expansion_range(p.y) && in_expansion_range(p.z);
}
///@}

///@{ a b - c d exactly, of doubles and of differences of doubles.
DISMANTLE_HOST_DEVICE inline Expansion<4> minor_exact(double a, double b, double c, double d) {
  return expansion_of(two_product(a, b)) + -expansion_of(two_product(c, d));
}
DISMANTLE_HOST_DEVICE inline Expansion<16> minor_exact(TwoTerms a, TwoTerms b, TwoTerms c, TwoTerms d) {
  return expansion_of(a) * expansion_of(b) + -(expansion_of(c) * expansion_of(d));
}
///@}

/// A difference of two points, exact in each coordinate.
struct ExactDifference {
  TwoTerms x;  ///< First coordinate.
  TwoTerms y;  ///< Second coordinate.
  TwoTerms z;  ///< Third coordinate.
  /// True if a coordinate is no double.
  DISMANTLE_HOST_DEVICE bool rounded() const { return x.low != 0 || y.low != 0 || z.low != 0; }
  /// The difference rounded to doubles.
  DISMANTLE_HOST_DEVICE Vec3 high() const { return {x.high, y.high, z.high}; }
};

/// p - q.
DISMANTLE_HOST_DEVICE inline ExactDifference exact_difference(Vec3 p, Vec3 q) {
  return {two_difference(p.x, q.x), two_difference(p.y, q.y), two_difference(p.z, q.z)};
}

///@{ Sums and products of double-doubles: within 4u^2 (|a| + |b|) and 7u^2 |a b| (Joldes, Muller, Popescu, "Tight and
/// rigorous error bounds for basic building blocks of double-word arithmetic", 2017: 2u^2 and 5u^2 where a and b have
/// one sign or the sum is taken relative to |a| + |b|).
DISMANTLE_HOST_DEVICE inline TwoTerms double_double_sum(TwoTerms a, TwoTerms b) {
  const TwoTerms high = two_sum(a.high, b.high);
  return fast_two_sum(high.high, high.low + (a.low + b.low));
}
DISMANTLE_HOST_DEVICE inline TwoTerms double_double_product(TwoTerms a, TwoTerms b) {
  const TwoTerms high = two_product(a.high, b.high);
  return fast_two_sum(high.high, high.low + (a.high * b.low + a.low * b.high));
}
DISMANTLE_HOST_DEVICE inline TwoTerms double_double_minor(TwoTerms a, TwoTerms b, TwoTerms c, TwoTerms d) {
  const TwoTerms subtrahend = double_double_product(c, d);
  return double_double_sum(double_double_product(a, b), {-subtrahend.high, -subtrahend.low});
}
///@}

/// Relative error bound of the determinant in double-doubles. A term of it passes two products and three sums, 7 + 4 +
/// 7 + 4 + 4 = 26 u^2, and two terms share a bound: 52 u^2, and room for the rounding of the bound.
inline constexpr double kDoubleDoubleError = 64 * 0x1p-106;

/// The sign of u x v . w if double-doubles decide it, else 0. @pre in the range of expansions
DISMANTLE_HOST_DEVICE inline int orient3d_double_double(const ExactDifference& u, const ExactDifference& v,
                                                        const ExactDifference& w) {
  const TwoTerms x = double_double_product(double_double_minor(u.y, v.z, u.z, v.y), w.x);
  const TwoTerms y = double_double_product(double_double_minor(u.z, v.x, u.x, v.z), w.y);
  const TwoTerms z = double_double_product(double_double_minor(u.x, v.y, u.y, v.x), w.z);
  const double det = double_double_sum(double_double_sum(x, y), z).high;
  const Vec3 e = max(magnitude(u.high()), magnitude(v.high())), size = magnitude(w.high());
  const double sum = e.y * e.z * size.x + e.z * e.x * size.y + e.x * e.y * size.z;
  const double bound = kDoubleDoubleError * sum + kExpansionSmallest * kExpansionSmallest;
  return det > bound ? 1 : (det < -bound ? -1 : 0);
}

/// u x v . w, exactly.
DISMANTLE_HOST_DEVICE inline Expansion<24> determinant_exact(Vec3 u, Vec3 v, Vec3 w) {
  return minor_exact(u.y, v.z, u.z, v.y) * w.x + minor_exact(u.z, v.x, u.x, v.z) * w.y +
         minor_exact(u.x, v.y, u.y, v.x) * w.z;
}

/// As orient3d_exact. @pre all coordinates are in_expansion_range
DISMANTLE_HOST_DEVICE inline int orient3d_expansion(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const ExactDifference u = exact_difference(b, a), v = exact_difference(c, a), w = exact_difference(d, a);
  const int clear = orient3d_double_double(u, v, w);
  if (clear != 0) return clear;
  if (!u.rounded() && !v.rounded() && !w.rounded()) return determinant_exact(u.high(), v.high(), w.high()).sign();

  return (minor_exact(u.y, v.z, u.z, v.y) * expansion_of(w.x) + minor_exact(u.z, v.x, u.x, v.z) * expansion_of(w.y) +
          minor_exact(u.x, v.y, u.y, v.x) * expansion_of(w.z))
      .sign();
}

/// As orient2d_exact. @pre all coordinates are in_expansion_range
DISMANTLE_HOST_DEVICE inline int orient2d_expansion(Vec2 a, Vec2 b, Vec2 c) {
  return minor_exact(two_difference(b.x, a.x), two_difference(c.y, a.y), two_difference(b.y, a.y),
                     two_difference(c.x, a.x))
      .sign();
}

/// A finite double in units of the smallest: 971 + 1074 + 53 bits, and one for a difference.
using WideCoordinate = WideInteger<66>;

/// The smaller of an exponent and that of a number's lowest bit; 0 has none.
DISMANTLE_HOST_DEVICE inline int lowest_exponent(double x, int so_far) {
  const DoubleParts parts = parts_of(x);
  return parts.sign != 0 && parts.exponent < so_far ? parts.exponent : so_far;
}

/// As orient3d_exact, for coordinates so large or small that doubles overflow or underflow.
[[gnu::noinline]] DISMANTLE_HOST_DEVICE inline int orient3d_wide(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 points[4] = {a, b, c, d};
  int unit = 971;
  for (const Vec3& p : points) unit = lowest_exponent(p.x, lowest_exponent(p.y, lowest_exponent(p.z, unit)));
  WideCoordinate difference[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      difference[i][k] = wide_integer_of<66>(points[i + 1][k], unit) - wide_integer_of<66>(a[k], unit);

  WideInteger<198> det;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const auto minor = difference[0][i] * difference[1][j] - difference[0][j] * difference[1][i];
    det = det + minor * difference[2][k];
  }
  return det.sign;
}

/// As orient2d_exact, for coordinates so large or small that doubles overflow or underflow.
[[gnu::noinline]] DISMANTLE_HOST_DEVICE inline int orient2d_wide(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 points[3] = {a, b, c};
  int unit = 971;
  for (const Vec2& p : points) unit = lowest_exponent(p.x, lowest_exponent(p.y, unit));
  const auto difference = [unit](double p, double q) {
    return wide_integer_of<66>(p, unit) - wide_integer_of<66>(q, unit);
  };
  return (difference(b.x, a.x) * difference(c.y, a.y) - difference(b.y, a.y) * difference(c.x, a.x)).sign;
}

/// The sign of ((b - a) x (c - a)) . (d - a), without a filter. Not inlined, so that the code of the filter stays
/// small.
/// @pre all coordinates are finite
[[gnu::noinline]] DISMANTLE_HOST_DEVICE inline int orient3d_exact(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const bool in_range =
      in_expansion_range(a) && in_expansion_range(b) && in_expansion_range(c) && in_expansion_range(d);
  return in_range ? orient3d_expansion(a, b, c, d) : orient3d_wide(a, b, c, d);
}

/// The sign of (b - a) x (c - a), as orient3d_exact. @pre all coordinates are finite
[[gnu::noinline]] DISMANTLE_HOST_DEVICE inline int orient2d_exact(Vec2 a, Vec2 b, Vec2 c) {
  const bool in_range = in_expansion_range(a) && in_expansion_range(b) && in_expansion_range(c);
  return in_range ? orient2d_expansion(a, b, c) : orient2d_wide(a, b, c);
}

}  // namespace detail
}  // namespace dismantle
