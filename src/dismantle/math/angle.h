// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace dismantle {

/// A full turn, 2 pi [rad].
inline constexpr double kTurn = 6.283185307179586;

/// What is left of a value when the nearest whole number of periods is taken from it: within half a period of 0, up to
/// rounding. Unlike std::remainder() not exact, and a fraction of its time.
inline double nearest_remainder(double value, double period) {
  return value - period * std::nearbyint(value / period);
}

}  // namespace dismantle
