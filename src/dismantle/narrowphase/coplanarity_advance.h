// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/coplanarity_cubic.h"
#include "dismantle/narrowphase/separating_axis.h"

namespace dismantle {

/// The rounding of restricting a cubic to [t, 1], relative to its largest coefficient: six weighted means, three deep,
/// each off by at most 3 u of the largest value (docs/design/0001-certified-ccd.md).
inline constexpr double kRestrictionError = 12 * kUnitRoundoff;

namespace detail {

/// How many times a cubic is cut; convergence to a simple root is quadratic.
inline constexpr int kClippingLimit = 12;

/// A cut that gains less than this is the last.
inline constexpr double kClippingLeastProgress = 0x1p-27;

/// The coefficients of the cubic on [t, 1] by de Casteljau's rule.
DISMANTLE_HOST_DEVICE inline void restrict_to_rest(const double (&c)[4], double t, double (&rest)[4]) {
  const double s = 1 - t;
  const double c01 = s * c[0] + t * c[1], c12 = s * c[1] + t * c[2], c23 = s * c[2] + t * c[3];
  const double c012 = s * c01 + t * c12, c123 = s * c12 + t * c23;
  rest[0] = s * c012 + t * c123;
  rest[1] = c123;
  rest[2] = c23;
  rest[3] = c[3];
}

/// The part of [0, 1] from 0 on in which the convex hull of the control points stays on the side of the first: a safe
/// advance, 0 where the first is within `error` of zero, 1 where there is no root. The hull reaches zero where the
/// first of the lines from a point before it to a point behind it does.
DISMANTLE_HOST_DEVICE inline double clipped(const double (&c)[4], double error) {
  const double sign = c[0] < 0 ? -1 : 1;
  const double height[4] = {sign * c[0] - error, sign * c[1] - error, sign * c[2] - error, sign * c[3] - error};
  if (!(height[0] > 0)) return 0;
  constexpr double kNoCrossing = 4;
  double advance = kNoCrossing;
  for (int j = 1; j < 4; ++j) {
    if (height[j] > 0) continue;
    for (int i = 0; i < j; ++i) {
      if (!(height[i] > 0)) continue;
      const double crossing = i + (j - i) * (height[i] / (height[i] - height[j]));
      if (!(crossing >= advance)) advance = crossing;
    }
  }
  if (advance == kNoCrossing) return 1;
  return advance > 0 ? advance * (kRoundDown / 3) : 0;
}

}  // namespace detail

/// The largest time that it finds up to which, from `t` on, the four points are certainly never in one plane (so that
/// their features do not meet): `t` itself where they cannot be told from coplanar there, 1 where they never are. Cuts
/// the cubic's control polygon again and again (Bezier clipping), which takes no root and no guess.
DISMANTLE_HOST_DEVICE inline double coplanarity_advance(const BernsteinCubic& cubic, double t) {
  double largest = 0;
  for (const double c : cubic.c) largest = largest > absolute(c) ? largest : absolute(c);
  const double error = cubic.error + kRestrictionError * largest;
  for (int i = 0; i < detail::kClippingLimit; ++i) {
    double rest[4];
    detail::restrict_to_rest(cubic.c, t, rest);
    const double part = detail::clipped(rest, error);
    if (part >= 1) return 1;
    const double gain = (1 - t) * part * kRoundDown;
    const double next = (t + gain) * kRoundDown;
    if (!(next > t)) return t;
    t = next;
    if (gain < detail::kClippingLeastProgress) return t;
  }
  return t;
}

}  // namespace dismantle
