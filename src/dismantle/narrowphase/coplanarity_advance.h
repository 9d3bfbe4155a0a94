// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/coplanarity_cubic.h"
#include "dismantle/narrowphase/separating_axis.h"

namespace dismantle {

/// The error bound of restricting a cubic to [t, 1] and the result to its beginning, relative to the largest
/// coefficient: twice six weighted means, three deep, each with an error of at most 3 u
/// (docs/design/0001-certified-ccd.md).
inline constexpr double kRestrictionError = 24 * kUnitRoundoff;

namespace detail {

/// Largest number of cuts of a control polygon; convergence to a simple root is quadratic.
inline constexpr int kClippingLimit = 12;

/// A cut that advances by less than this is the last.
inline constexpr double kClippingMinProgress = 0x1p-27;

/// Position of the first cut relative to the expected root.
inline constexpr double kBeforeRoot = 1 - 0x1p-34;

/// The Bernstein coefficients of a cubic, times the sign of the first, less the error bound: the exact cubic has no
/// root where the polynomial of these is positive.
struct CubicHeights {
  double at[4];  ///< The coefficients.

  /// True if the polynomial is positive on all of [0, 1].
  DISMANTLE_HOST_DEVICE bool all_positive() const { return at[0] > 0 && at[1] > 0 && at[2] > 0 && at[3] > 0; }
};

/// The heights of a cubic on [t, 1], by de Casteljau's algorithm. @param error the error bound
DISMANTLE_HOST_DEVICE inline CubicHeights heights_of_rest(const double (&c)[4], double t, double error) {
  const double s = 1 - t;
  const double c01 = s * c[0] + t * c[1], c12 = s * c[1] + t * c[2], c23 = s * c[2] + t * c[3];
  const double c012 = s * c01 + t * c12, c123 = s * c12 + t * c23;
  const double start = s * c012 + t * c123;
  const double sign = start < 0 ? -1 : 1;
  return {{sign * start - error, sign * c123 - error, sign * c23 - error, sign * c[3] - error}};
}

/// True if the polynomial is positive on [0, x], by its coefficients on that interval.
DISMANTLE_HOST_DEVICE inline bool positive_until(const CubicHeights& h, double x) {
  const double s = 1 - x;
  const double c01 = s * h.at[0] + x * h.at[1], c12 = s * h.at[1] + x * h.at[2], c23 = s * h.at[2] + x * h.at[3];
  const double c012 = s * c01 + x * c12, c123 = s * c12 + x * c23;
  return h.at[0] > 0 && c01 > 0 && c012 > 0 && s * c012 + x * c123 > 0;
}

/// An estimate of the first root, perhaps not finite: two steps of Laguerre's method to the right, from 0.
DISMANTLE_HOST_DEVICE inline double expected_root(const CubicHeights& h) {
  using std::sqrt;
  const double a1 = 3 * (h.at[1] - h.at[0]), a2 = 3 * ((h.at[2] - h.at[1]) - (h.at[1] - h.at[0]));
  const double a3 = (h.at[3] - h.at[0]) - 3 * (h.at[2] - h.at[1]);
  double x = 0;
  for (int i = 0; i < 2; ++i) {
    const double value = h.at[0] + x * (a1 + x * (a2 + x * a3));
    const double slope = a1 + x * (2 * a2 + x * (3 * a3)), bend = 2 * a2 + x * (6 * a3);
    const double square = 4 * slope * slope - 6 * value * bend;
    x += 3 * value / (sqrt(square > 0 ? square : 0) - slope);
  }
  return x;
}

/// The end of the interval from 0 on in which the convex hull of the control points is positive: 0 where the first is
/// not, 1 where all are. The hull reaches zero where the first of the lines from a point above to a later one below
/// does.
DISMANTLE_HOST_DEVICE inline double clipped(const CubicHeights& h) {
  if (!(h.at[0] > 0)) return 0;
  constexpr double kNoCrossing = 4;
  double advance = kNoCrossing;
  for (int j = 1; j < 4; ++j) {
    if (h.at[j] > 0) continue;
    for (int i = 0; i < j; ++i) {
      if (!(h.at[i] > 0)) continue;
      const double crossing = i + (j - i) * (h.at[i] / (h.at[i] - h.at[j]));
      if (!(crossing >= advance)) advance = crossing;
    }
  }
  if (advance == kNoCrossing) return 1;
  return advance > 0 ? advance * (kRoundDown / 3) : 0;
}

/// The time after `part` of the rest [t, 1] of the motion, certainly rounded down.
DISMANTLE_HOST_DEVICE inline double time_after(double t, double part) {
  return (t + (1 - t) * part * kRoundDown) * kRoundDown;
}

}  // namespace detail

/// A time up to which, from `t` on, the four points of a cubic are certainly never coplanar, so that their features do
/// not meet: `t` itself where rounding cannot exclude coplanarity there, 1 where they never are coplanar. The first
/// candidate is a time just before an estimated root; where that fails, the control polygon is cut repeatedly (Bezier
/// clipping).
DISMANTLE_HOST_DEVICE inline double coplanarity_advance(const BernsteinCubic& cubic, double t) {
  const double error = cubic.error + kRestrictionError * largest_coefficient(cubic);
  detail::CubicHeights rest = detail::heights_of_rest(cubic.c, t, error);
  if (!(rest.at[0] > 0)) return t;
  if (rest.all_positive()) return 1;
  const double root = detail::expected_root(rest) * detail::kBeforeRoot;
  if (root > 0 && root < 1 && detail::positive_until(rest, root)) {
    const double next = detail::time_after(t, root);
    return next > t ? next : t;
  }

  for (int i = 0; i < detail::kClippingLimit; ++i) {
    const double part = detail::clipped(rest);
    if (part >= 1) return 1;
    const double next = detail::time_after(t, part);
    if (!(next > t)) return t;
    const double gain = next - t;
    t = next;
    if (gain < detail::kClippingMinProgress) return t;
    rest = detail::heights_of_rest(cubic.c, t, error);
  }
  return t;
}

}  // namespace dismantle
