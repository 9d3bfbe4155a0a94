// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle {

/// A full turn, 2 pi [rad].
inline constexpr double kTurn = 6.283185307179586;

}  // namespace dismantle
