// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"
#include "dismantle/math/vec3.h"

#include <limits>

namespace dismantle {

/// Infinity, as a constant that device code can use.
inline constexpr float kKdopInfinity = std::numeric_limits<float>::infinity();

/// A discrete oriented polytope over 8 fixed axes (16 half-spaces): the bounding volume of the collision streams (Du et
/// al. 2015, section 5; Klosowski et al. 1998). One cache line. Axes, not normalised: x, y, z, x+y, x+z, y+z, x-y, x-z.
/// In float32, rounded outward: it certainly contains the points that it bounds.
struct alignas(64) Kdop16 {
  static constexpr int kAxisCount = 8;  ///< Number of axes.
  float lower[kAxisCount];              ///< Smallest projections [mm].
  float upper[kAxisCount];              ///< Largest projections [mm].

  /// Empty.
  DISMANTLE_HOST_DEVICE Kdop16() {
    for (int k = 0; k < kAxisCount; ++k) {
      lower[k] = kKdopInfinity;
      upper[k] = -kKdopInfinity;
    }
  }
  /// True if it contains no point.
  DISMANTLE_HOST_DEVICE bool empty() const { return lower[0] > upper[0]; }
  friend bool operator==(const Kdop16&, const Kdop16&) = default;
};

/// Coordinates of up to this size can be bounded in float32 [mm].
inline constexpr double kKdopLargestCoordinate = 1e36;

/// Outward shift of a bound, relative to its size: at least one unit in the last place of float32, which covers the
/// half unit of rounding a projection to float and the error of its sum in double together.
inline constexpr float kKdopRelativeRounding = 1.1920929e-7f;
/// Outward shift of a bound near zero, where float32 loses relative accuracy [mm].
inline constexpr float kKdopAbsoluteRounding = 1.1754944e-38f;

/// Two doubles in 16 aligned bytes: a vector of the compiler if it has them (2.5 times as fast), a plain struct in
/// device code and the host code beside it. Layout and results are the same.
#if defined(__GNUC__) && !defined(__CUDACC__)
using DoublePair = double __attribute__((vector_size(16)));
///@{ a < b ? a : b and a > b ? a : b, each double by itself.
inline DoublePair min(DoublePair a, DoublePair b) {
  return a < b ? a : b;
}
inline DoublePair max(DoublePair a, DoublePair b) {
  return a > b ? a : b;
}
///@}
#else
struct alignas(16) DoublePair {
  double value[2];  ///< The doubles.
  /// One of the doubles. @param i 0 or 1
  DISMANTLE_HOST_DEVICE double operator[](int i) const { return value[i]; }
};
///@{ a < b ? a : b and a > b ? a : b, each double by itself.
DISMANTLE_HOST_DEVICE inline DoublePair min(DoublePair a, DoublePair b) {
  return {a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
}
DISMANTLE_HOST_DEVICE inline DoublePair max(DoublePair a, DoublePair b) {
  return {a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1]};
}
///@}
#endif
static_assert(sizeof(DoublePair) == 16);
static_assert(alignof(DoublePair) == 16);

/// The extents of points along the axes of Kdop16, in double. Extend it by points, then take rounded_outward().
struct KdopOfPoints {
  static constexpr int kPairCount = Kdop16::kAxisCount / 2;  ///< Pairs of axes.
  DoublePair lower[kPairCount];                              ///< Smallest projections [mm].
  DoublePair upper[kPairCount];                              ///< Largest projections [mm].

  /// No points.
  DISMANTLE_HOST_DEVICE KdopOfPoints() {
    for (int k = 0; k < kPairCount; ++k) {
      lower[k] = DoublePair{kKdopInfinity, kKdopInfinity};
      upper[k] = DoublePair{-kKdopInfinity, -kKdopInfinity};
    }
  }

  /// Adds a point. @pre finite coordinates within kKdopLargestCoordinate
  DISMANTLE_HOST_DEVICE void extend(Vec3 p) {
    const DoublePair along[kPairCount] = {DoublePair{p.x, p.y}, DoublePair{p.z, p.x + p.y},
                                          DoublePair{p.x + p.z, p.y + p.z}, DoublePair{p.x - p.y, p.x - p.z}};
    for (int k = 0; k < kPairCount; ++k) {
      lower[k] = min(along[k], lower[k]);
      upper[k] = max(along[k], upper[k]);
    }
  }

  /// The k-DOP that certainly contains the points, grown by `margin` [mm, >= 0] along every axis (by at least the
  /// margin's length in space: the diagonal axes are sqrt(2) long, so their bounds grow by 1.5 times as much).
  DISMANTLE_HOST_DEVICE Kdop16 rounded_outward(float margin) const {
    Kdop16 result;
    for (int k = 0; k < Kdop16::kAxisCount; ++k) {
      const float grow = k < 3 ? margin : 1.5f * margin;
      const float low = static_cast<float>(lower[k / 2][k % 2]), high = static_cast<float>(upper[k / 2][k % 2]);
      const float low_size = low < 0 ? -low : low, high_size = high < 0 ? -high : high;
      // Two roundings of `low - grow - pad` are covered by doubling the pad.
      result.lower[k] = low - (grow + (2 * kKdopRelativeRounding * (low_size + grow) + kKdopAbsoluteRounding));
      result.upper[k] = high + (grow + (2 * kKdopRelativeRounding * (high_size + grow) + kKdopAbsoluteRounding));
    }
    return result;
  }
};

/// The k-DOP of two, without rounding: a parent contains its children bit for bit.
DISMANTLE_HOST_DEVICE inline Kdop16 united(const Kdop16& a, const Kdop16& b) {
  Kdop16 result;
  for (int k = 0; k < Kdop16::kAxisCount; ++k) {
    result.lower[k] = a.lower[k] < b.lower[k] ? a.lower[k] : b.lower[k];
    result.upper[k] = a.upper[k] > b.upper[k] ? a.upper[k] : b.upper[k];
  }
  return result;
}

/// False only if one of the axes separates the closed k-DOPs; those of two touching objects overlap.
DISMANTLE_HOST_DEVICE inline bool overlaps(const Kdop16& a, const Kdop16& b) {
  int apart = 0;
  for (int k = 0; k < Kdop16::kAxisCount; ++k) apart |= (a.lower[k] > b.upper[k]) | (b.lower[k] > a.upper[k]);
  return apart == 0;
}

/// True if `outer` contains `inner`, bound by bound.
DISMANTLE_HOST_DEVICE inline bool contains(const Kdop16& outer, const Kdop16& inner) {
  int outside = 0;
  for (int k = 0; k < Kdop16::kAxisCount; ++k)
    outside |= (inner.lower[k] < outer.lower[k]) | (inner.upper[k] > outer.upper[k]);
  return outside == 0;
}

/// A size to compare k-DOPs by: the sum of the three box edges [mm].
DISMANTLE_HOST_DEVICE inline float extent(const Kdop16& a) {
  return (a.upper[0] - a.lower[0]) + (a.upper[1] - a.lower[1]) + (a.upper[2] - a.lower[2]);
}

}  // namespace dismantle
