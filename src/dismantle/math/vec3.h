// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"
#include "dismantle/math/min_max.h"

#include <cmath>

namespace dismantle {

/// A vector or point of three coordinates. Its functions use only + - * / sqrt and comparisons, so host and device give
/// the same bits.
template <class T>
struct Vec3T {
  T x = 0;  ///< First coordinate.
  T y = 0;  ///< Second coordinate.
  T z = 0;  ///< Third coordinate.

  ///@{ A coordinate. @param i 0 to 2
  DISMANTLE_HOST_DEVICE T& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
  DISMANTLE_HOST_DEVICE const T& operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  ///@}

  ///@{ Coordinate by coordinate.
  DISMANTLE_HOST_DEVICE friend constexpr bool operator==(const Vec3T& a, const Vec3T& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
  DISMANTLE_HOST_DEVICE friend constexpr Vec3T operator+(Vec3T a, Vec3T b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  DISMANTLE_HOST_DEVICE friend constexpr Vec3T operator-(Vec3T a, Vec3T b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  DISMANTLE_HOST_DEVICE friend constexpr Vec3T operator-(Vec3T a) { return {-a.x, -a.y, -a.z}; }
  DISMANTLE_HOST_DEVICE friend constexpr Vec3T operator*(T s, Vec3T a) { return {s * a.x, s * a.y, s * a.z}; }
  DISMANTLE_HOST_DEVICE friend constexpr Vec3T operator*(Vec3T a, T s) { return {s * a.x, s * a.y, s * a.z}; }
  DISMANTLE_HOST_DEVICE friend constexpr Vec3T operator/(Vec3T a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  DISMANTLE_HOST_DEVICE Vec3T& operator+=(Vec3T b) { return *this = *this + b; }
  DISMANTLE_HOST_DEVICE Vec3T& operator-=(Vec3T b) { return *this = *this - b; }
  DISMANTLE_HOST_DEVICE Vec3T& operator*=(T s) { return *this = *this * s; }
  ///@}
};

using Vec3 = Vec3T<double>;  ///< In double precision.
using Vec3f = Vec3T<float>;  ///< In single precision.

/// The inner product.
template <class T>
DISMANTLE_HOST_DEVICE constexpr T dot(Vec3T<T> a, Vec3T<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The cross product.
template <class T>
DISMANTLE_HOST_DEVICE constexpr Vec3T<T> cross(Vec3T<T> a, Vec3T<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The square of the Euclidean length.
template <class T>
DISMANTLE_HOST_DEVICE constexpr T length_squared(Vec3T<T> a) {
  return dot(a, a);
}

/// The Euclidean length.
template <class T>
DISMANTLE_HOST_DEVICE T length(Vec3T<T> a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// `a` scaled to length 1; the zero vector stays zero.
template <class T>
DISMANTLE_HOST_DEVICE Vec3T<T> normalized(Vec3T<T> a) {
  const T l = length(a);
  return l > 0 ? a / l : Vec3T<T>{};
}

///@{ min() and max() of each coordinate.
template <class T>
DISMANTLE_HOST_DEVICE constexpr Vec3T<T> min(Vec3T<T> a, Vec3T<T> b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}

template <class T>
DISMANTLE_HOST_DEVICE constexpr Vec3T<T> max(Vec3T<T> a, Vec3T<T> b) {
  return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}
///@}

/// The largest absolute coordinate.
template <class T>
DISMANTLE_HOST_DEVICE T max_abs(Vec3T<T> a) {
  using std::fabs;  // a comparison with 0 would become a branch that nothing can predict
  const T x = fabs(a.x), y = fabs(a.y), z = fabs(a.z);
  const T xy = x > y ? x : y;
  return xy > z ? xy : z;
}

/// The sum of the absolute coordinates.
template <class T>
DISMANTLE_HOST_DEVICE T norm_one(Vec3T<T> a) {
  using std::fabs;
  return fabs(a.x) + fabs(a.y) + fabs(a.z);
}

/// True if no coordinate is infinite or NaN.
template <class T>
DISMANTLE_HOST_DEVICE bool is_finite(Vec3T<T> a) {
  return a.x - a.x == 0 && a.y - a.y == 0 && a.z - a.z == 0;
}

}  // namespace dismantle
