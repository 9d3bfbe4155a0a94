// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dismantle {

/// A full turn, 2 pi [rad].
inline constexpr double kTurn = 6.283185307179586;

/// The value less the nearest multiple of the period: within half a period of 0. A fast std::remainder() with a
/// rounding error of a few units in the last place of the value.
inline double nearest_remainder(double value, double period) {
  return value - period * std::nearbyint(value / period);
}

}  // namespace dismantle
