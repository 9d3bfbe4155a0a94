// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_result.h"

namespace dismantle {

/// The unit roundoff u: half the distance from 1 to the next double.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// The error bound of a projected gap on an axis w, in units of |w_x| M_x + |w_y| M_y + |w_z| M_z, M being the largest
/// coordinates relative to the local origin. docs/design/0001-certified-ccd.md derives 10 u + O(u^2); the rest is
/// margin for the rounding of the bound itself.
inline constexpr double kGapErrorFactor = 12 * kUnitRoundoff;

/// Covers all products of a projection that underflow (each has an error of at most 2^-1075).
inline constexpr double kUnderflowError = 0x1p-1022;

///@{ Factors that certainly round down or up: every short chain of products, quotients and roots here has a relative
/// error of at most 8 u.
inline constexpr double kRoundDown = 1 - 16 * kUnitRoundoff;
inline constexpr double kRoundUp = 1 + 16 * kUnitRoundoff;
///@}

/// The error bound of a weighted mean of two gaps, relative to that of their sizes; 4 u is the derived bound.
inline constexpr double kMeanError = 8 * kUnitRoundoff;

/// Nothing overflows where error bounds and allowances are below this.
inline constexpr double kLargestBound = 0x1p900;

/// The absolute value; exact, and without a branch, unlike a comparison with zero.
DISMANTLE_HOST_DEVICE inline double absolute(double x) {
  using std::fabs;
  return fabs(x);
}

/// The absolute value of each coordinate.
DISMANTLE_HOST_DEVICE inline Vec3 absolute(Vec3 v) {
  return {absolute(v.x), absolute(v.y), absolute(v.z)};
}

/// Two convex hulls A and B of points that move linearly, relative to the first point of A at the same time. A
/// difference of doubles has a relative error of at most u, so that unlike a common origin this costs no accuracy
/// however far out the points are.
template <int kCountA, int kCountB>
struct RelativeHulls {
  ///@{ Number of points.
  static constexpr int kA = kCountA, kB = kCountB;
  ///@}
  Vec3 a[2][kCountA];  ///< Points of A [mm], shape [end][point]; point 0 is zero.
  Vec3 b[2][kCountB];  ///< Points of B [mm], shape [end][point].
  Vec3 reach[2];       ///< Largest absolute value of each coordinate [mm], shape [end].

  /// Takes the positions at the beginning (t0) and the end (t1) of the motion [mm].
  /// @pre each argument points to as many finite positions as its hull has points.
  DISMANTLE_HOST_DEVICE RelativeHulls(const Vec3* a_t0, const Vec3* a_t1, const Vec3* b_t0, const Vec3* b_t1) {
    for (int i = 1; i < kCountA; ++i) {
      add(0, a[0][i] = a_t0[i] - a_t0[0]);
      add(1, a[1][i] = a_t1[i] - a_t1[0]);
    }
    for (int j = 0; j < kCountB; ++j) {
      add(0, b[0][j] = b_t0[j] - a_t0[0]);
      add(1, b[1][j] = b_t1[j] - a_t1[0]);
    }
  }

 private:
  DISMANTLE_HOST_DEVICE void add(int end, Vec3 p) { reach[end] = max(reach[end], absolute(p)); }
};

/// The length of `w`, certainly not above the exact one if `down`, certainly not below it otherwise.
DISMANTLE_HOST_DEVICE inline double length_rounded(Vec3 w, bool down) {
  using std::sqrt;
  const double square = length_squared(w);
  // A smaller square may have lost its leading bits to underflow.
  if (!(square > 0x1p-900)) return down ? 0 : absolute(w.x) + absolute(w.y) + absolute(w.z) + kUnderflowError;
  return sqrt(square) * (down ? kRoundDown : kRoundUp);
}

/// The projections of two hulls on an axis w at both ends of a motion. Below, "separates" means that the exact gap from
/// A to B along w exceeds -allowed * |w|: the hulls overlap by less than `allowed` along it, or for a negative
/// `allowed` are more than that apart.
///   1. gap(end) > 0: w certainly separates at that end, despite rounding.
///   2. separates_throughout(): w certainly separates during the whole motion.
///   3. separates_until(now) >= now: w certainly separates from `now` up to the time returned.
///   4. Nothing is claimed where coordinates overflow: 2 gives false and 3 gives -1 then.
template <int kCountA, int kCountB>
struct AxisProjections {
  ///@{ Projections of the points, shape [end][point].
  double a[2][kCountA], b[2][kCountB];
  ///@}
  double margin[2];  ///< The allowance less the error bound, shape [end]: added to every difference.
  bool usable;       ///< True if nothing overflowed.

  /// @param w the axis, of any length; @param allowed [mm]
  DISMANTLE_HOST_DEVICE AxisProjections(const RelativeHulls<kCountA, kCountB>& hulls, Vec3 w, double allowed) {
    const double allowance = allowed == 0 ? 0 : allowed * length_rounded(w, allowed > 0);
    const Vec3 size = absolute(w);
    double bound[2];
    for (int end = 0; end < 2; ++end) {
      a[end][0] = 0;
      for (int i = 1; i < kCountA; ++i) a[end][i] = dot(w, hulls.a[end][i]);
      for (int j = 0; j < kCountB; ++j) b[end][j] = dot(w, hulls.b[end][j]);
      bound[end] = kGapErrorFactor * dot(size, hulls.reach[end]) + kUnderflowError;
      margin[end] = allowance - bound[end];
    }
    usable = bound[0] < kLargestBound && bound[1] < kLargestBound && absolute(allowance) < kLargestBound;
  }

  /// The gap at an end, less the error bound and plus the allowance (property 1), times |w|.
  DISMANTLE_HOST_DEVICE double gap(int end) const { return (min_of(b[end]) - max_of(a[end])) + margin[end]; }
  /// Reverses the axis.
  DISMANTLE_HOST_DEVICE void turn() {
    for (int end = 0; end < 2; ++end) {
      for (double& x : a[end]) x = -x;
      for (double& x : b[end]) x = -x;
    }
  }

  /// True if the axis certainly separates during the whole motion (property 2).
  DISMANTLE_HOST_DEVICE bool separates_throughout() const { return usable && gap(0) > 0 && gap(1) > 0; }

  /// The time up to which the axis certainly separates from `now` on (property 3); -1 where it does not at `now`. Every
  /// projected difference of a point of B and one of A is linear in time, so that its zero has a closed form.
  DISMANTLE_HOST_DEVICE double separates_until(double now) const {
    // Most axes that are tried end here; with few points computing all differences costs less.
    if constexpr (kCountA * kCountB > 4)
      if (!(rounded_gap_at(now) > 0)) return -1;
    double min_now = kLargestBound, min_at_end = kLargestBound, until = 1;
    for (int i = 0; i < kCountA; ++i)
      for (int j = 0; j < kCountB; ++j) {
        const double start = (b[0][j] - a[0][i]) + margin[0], finish = (b[1][j] - a[1][i]) + margin[1];
        const double from_start = (1 - now) * start, from_finish = now * finish;
        const double here = (from_start + from_finish) - kMeanError * (absolute(from_start) + absolute(from_finish));
        min_now = here < min_now ? here : min_now;
        min_at_end = finish < min_at_end ? finish : min_at_end;
        const double last = start / (start - (finish < 0 ? finish : 0));
        until = last < until ? last : until;
      }
    if (!usable || !(min_now > 0)) return -1;
    return min_at_end > 0 ? 1 : until * kRoundDown - kUnderflowError;
  }

 private:
  /// The gap at `now` without a bound of its rounding: no proof.
  DISMANTLE_HOST_DEVICE double rounded_gap_at(double now) const {
    double min_b = kLargestBound, max_a = -kLargestBound;
    for (int j = 0; j < kCountB; ++j) {
      const double x = (1 - now) * b[0][j] + now * b[1][j];
      min_b = x < min_b ? x : min_b;
    }
    for (int i = 0; i < kCountA; ++i) {
      const double x = (1 - now) * a[0][i] + now * a[1][i];
      max_a = x > max_a ? x : max_a;
    }
    return (min_b - max_a) + ((1 - now) * margin[0] + now * margin[1]);
  }

  template <int kCount>
  DISMANTLE_HOST_DEVICE static double min_of(const double (&x)[kCount]) {
    double m = x[0];
    for (int i = 1; i < kCount; ++i) m = x[i] < m ? x[i] : m;
    return m;
  }
  template <int kCount>
  DISMANTLE_HOST_DEVICE static double max_of(const double (&x)[kCount]) {
    double m = x[0];
    for (int i = 1; i < kCount; ++i) m = x[i] > m ? x[i] : m;
    return m;
  }
};

}  // namespace dismantle
