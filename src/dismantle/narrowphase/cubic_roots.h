// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/contract.h"
#include "dismantle/narrowphase/coplanarity_cubic.h"

namespace dismantle {

/// A list of times in [0, 1], ascending.
template <int kCapacity>
struct TimeList {
  double time[kCapacity] = {};  ///< The times; the first `count` are used.
  int count = 0;                ///< Number of times.

  /// Inserts `t` in order; drops it where it is outside [0, 1] or not a number. @pre count < kCapacity
  DISMANTLE_HOST_DEVICE void insert(double t) {
    if (!(t >= 0 && t <= 1)) return;
    DISMANTLE_EXPECT(count < kCapacity);
    int index = count++;
    for (; index > 0 && time[index - 1] > t; --index) time[index] = time[index - 1];
    time[index] = t;
  }
};

/// The roots of a cubic: at most four nodes (both ends, two turning points) and three crossings between them.
using CubicRoots = TimeList<7>;

/// The error bound of the values of a cubic or quadratic in Bernstein form, at its rounded turning points too, relative
/// to the largest coefficient.
inline constexpr double kCubicValueError = 32 * 0x1p-53;

/// The value of a cubic at `t`.
DISMANTLE_HOST_DEVICE inline double value_at(const BernsteinCubic& cubic, double t) {
  const double s = 1 - t;
  return ((cubic.c[0] * s + 3 * cubic.c[1] * t) * s + 3 * cubic.c[2] * (t * t)) * s + cubic.c[3] * (t * t * t);
}

/// The roots of q0 (1-t)^2 + 2 q1 (1-t) t + q2 t^2 in [0, 1]. A negative discriminant counts as zero, so that no
/// double root is lost by rounding: the list may hold a time that is no root.
DISMANTLE_HOST_DEVICE inline TimeList<2> quadratic_roots(double q0, double q1, double q2) {
  using std::sqrt;
  const double a = (q0 - q1) + (q2 - q1), half_b = q1 - q0;
  const double discriminant = half_b * half_b - a * q0;
  const double root = discriminant > 0 ? sqrt(discriminant) : 0;
  const double far = half_b < 0 ? -half_b + root : -half_b - root;
  TimeList<2> times;
  if (a != 0) times.insert(far / a);
  if (far != 0) times.insert(q0 / far);
  return times;
}

namespace detail {

/// The root in [low, high], at whose ends the values have opposite signs: regula falsi that halves the value of an end
/// which stays (the Illinois rule), with a bisection every eighth step, until the value is below its rounding error or
/// to the last bit.
DISMANTLE_HOST_DEVICE inline double crossing_between(const BernsteinCubic& cubic, double low, double high) {
  const double lost = kCubicValueError / 16 * largest_coefficient(cubic);
  double at_low = value_at(cubic, low), at_high = value_at(cubic, high);
  int same_side = 0;
  for (int i = 0; i < 200; ++i) {
    double middle = i % 8 == 7 ? 0.5 * (low + high) : low + (high - low) * (at_low / (at_low - at_high));
    if (!(middle > low && middle < high)) middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) break;
    const double value = value_at(cubic, middle);
    if (value <= lost && value >= -lost) return middle;
    if ((value < 0) == (at_low < 0)) {
      low = middle;
      at_low = value;
      if (same_side < 0) at_high *= 0.5;
      same_side = -1;
    } else {
      high = middle;
      at_high = value;
      if (same_side > 0) at_low *= 0.5;
      same_side = 1;
    }
  }
  return low;
}

}  // namespace detail

/// All roots of the cubic in [0, 1], ascending. No root that the double coefficients have is missed: [0, 1] is cut at
/// the turning points; a cut or an end where the value is within rounding or `cubic.error` of zero is itself listed
/// (so is the turning point next to a double root), and every change of sign between two cuts is followed to the last
/// bit. The list may hold times at which the cubic is only nearly zero. Where all coefficients are within
/// `cubic.error`, the list holds both ends: see always_coplanar.
DISMANTLE_HOST_DEVICE inline CubicRoots cubic_roots(const BernsteinCubic& cubic) {
  const double near_zero = cubic.error + kCubicValueError * largest_coefficient(cubic);
  const TimeList<2> turns = quadratic_roots(cubic.c[1] - cubic.c[0], cubic.c[2] - cubic.c[1], cubic.c[3] - cubic.c[2]);
  TimeList<4> cuts;
  cuts.insert(0);
  for (int i = 0; i < turns.count; ++i) cuts.insert(turns.time[i]);
  cuts.insert(1);

  CubicRoots roots;
  double before = 0;
  for (int i = 0; i < cuts.count; ++i) {
    const double value = value_at(cubic, cuts.time[i]);
    if (value <= near_zero && value >= -near_zero) roots.insert(cuts.time[i]);
    if (i > 0 && ((before < 0 && value > 0) || (before > 0 && value < 0)))
      roots.insert(detail::crossing_between(cubic, cuts.time[i - 1], cuts.time[i]));
    before = value;
  }
  return roots;
}

/// True where the coefficients cannot be told from zero: the four points are (nearly) in one plane all the time, and
/// coplanarity says nothing about when they meet.
DISMANTLE_HOST_DEVICE inline bool always_coplanar(const BernsteinCubic& cubic) {
  return largest_coefficient(cubic) <= cubic.error;
}

}  // namespace dismantle
