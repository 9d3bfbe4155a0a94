// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

#include <cmath>
#include <limits>

/// Conversions between double and float32.
namespace dismantle {

/// The vector in float32, each coordinate rounded to nearest.
inline Vec3f to_float(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The vector in double; exact.
inline Vec3 to_double(Vec3f v) {
  return {v.x, v.y, v.z};
}

/// A float that is not less than x, and at most two units in the last place above it.
inline float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return f >= x ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

}  // namespace dismantle
