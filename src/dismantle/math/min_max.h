// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"

#include <type_traits>

namespace dismantle {

/// a < b ? a : b, on the host and on the device: the smaller number; `b` where they compare equal (zeros of either
/// sign) or one is NaN. As SSE and Lanes have it, and not as std::min, which gives `a` there.
template <class T>
requires std::is_arithmetic_v<T> DISMANTLE_HOST_DEVICE constexpr T min(T a, T b) {
  return a < b ? a : b;
}

/// a > b ? a : b, on the host and on the device: the larger number; `b` where they compare equal or one is NaN.
template <class T>
requires std::is_arithmetic_v<T> DISMANTLE_HOST_DEVICE constexpr T max(T a, T b) {
  return a > b ? a : b;
}

}  // namespace dismantle
