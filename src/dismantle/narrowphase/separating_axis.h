// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_result.h"

namespace dismantle {

/// Half the distance from 1 to the next double: the unit roundoff.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// The error bound of a projected gap, in units of u * (|w_x| M_x + |w_y| M_y + |w_z| M_z), M the largest coordinates
/// relative to the local origin. docs/design/0001-certified-ccd.md derives 10 u + O(u^2); the rest is margin for the
/// rounding of the bound itself.
inline constexpr double kGapErrorFactor = 12 * kUnitRoundoff;

/// Stands for all products of a projection that underflow (each is off by at most 2^-1075).
inline constexpr double kUnderflowError = 0x1p-1022;

/// Every short chain of products, quotients and roots here is off by at most 8 u relatively; scaling by these rounds it
/// down or up for certain.
inline constexpr double kRoundDown = 1 - 16 * kUnitRoundoff;
inline constexpr double kRoundUp = 1 + 16 * kUnitRoundoff;

/// The relative error of the mean of two gaps is below 4 u of the mean of their sizes.
inline constexpr double kMeanError = 8 * kUnitRoundoff;

/// Where error bounds and allowances are below this nothing can overflow.
inline constexpr double kLargestBound = 0x1p900;

/// The absolute value; exact, and unlike a comparison with zero it takes no branch.
DISMANTLE_HOST_DEVICE inline double absolute(double x) {
  using std::fabs;
  return fabs(x);
}

DISMANTLE_HOST_DEVICE inline Vec3 absolute(Vec3 v) {
  return {absolute(v.x), absolute(v.y), absolute(v.z)};
}

/// Two convex hulls of points that move linearly, seen from the first point of A, which stays at the origin: at either
/// end its position is taken off all others. A difference of doubles is off by at most u relatively, so unlike a common
/// origin this costs no accuracy however far out the points are.
template <int kCountA, int kCountB>
struct RelativeHulls {
  static constexpr int kA = kCountA, kB = kCountB;
  Vec3 a[2][kCountA];  ///< [end][point]; point 0 is zero.
  Vec3 b[2][kCountB];  ///< [end][point]
  Vec3 reach[2];       ///< The largest absolute value of each coordinate at that end.

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

/// The hulls' projections on an axis at both ends, and what has to be added to a difference so that, where it is
/// positive, the exact gap certainly exceeds -allowed * |axis| (with a negative `allowed`: a distance that is asked
/// for).
template <int kCountA, int kCountB>
struct AxisProjections {
  double a[2][kCountA], b[2][kCountB];
  double margin[2];
  bool usable;  ///< Nothing overflowed. Where false nothing is proved.

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

  /// The certified gap at an end, with B on the side that the axis points to; > 0 is proof.
  DISMANTLE_HOST_DEVICE double gap(int end) const { return (least(b[end]) - most(a[end])) + margin[end]; }
  /// Turns the axis round.
  DISMANTLE_HOST_DEVICE void turn() {
    for (int end = 0; end < 2; ++end) {
      for (double& x : a[end]) x = -x;
      for (double& x : b[end]) x = -x;
    }
  }

  /// True where the axis certainly separates during the whole motion.
  DISMANTLE_HOST_DEVICE bool separates_throughout() const { return usable && gap(0) > 0 && gap(1) > 0; }

  /// Until when the axis certainly separates, from `now` on; -1 where it does not at `now`. Every projected difference
  /// of a point of B and one of A is linear in time, so each lasts until a time in closed form.
  DISMANTLE_HOST_DEVICE double separates_until(double now) const {
    // Most axes that are only tried end here; of few points all differences cost less.
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
  /// The certified gap at `now` but for rounding: of no use as a proof.
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
  DISMANTLE_HOST_DEVICE static double least(const double (&x)[kCount]) {
    double m = x[0];
    for (int i = 1; i < kCount; ++i) m = x[i] < m ? x[i] : m;
    return m;
  }
  template <int kCount>
  DISMANTLE_HOST_DEVICE static double most(const double (&x)[kCount]) {
    double m = x[0];
    for (int i = 1; i < kCount; ++i) m = x[i] > m ? x[i] : m;
    return m;
  }
};

}  // namespace dismantle
