// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/contract.h"
#include "dismantle/core/span.h"

#include <type_traits>

namespace dismantle {

/// How many lanes a kernel works in (math/lanes.h). One is the scalar reference.
enum class LaneCount : int { One = 1, Four = 4, Eight = 8, Sixteen = 16 };

/// The counts that this machine can run, from the least to the greatest: One and Four always, Eight with AVX2, Sixteen
/// with AVX-512 (F, BW, DQ and VL).
Span<const LaneCount> lane_counts();

/// The greatest of lane_counts().
LaneCount widest_lanes();

/// Calls `call` with the count as a constant (std::integral_constant<int, 8>, which converts to int in constant
/// expressions), so that it can name the kernel of that width; gives what that gives.
/// @pre `count` is one of lane_counts()
template <class Call>
decltype(auto) with_lanes(LaneCount count, Call&& call) {
  DISMANTLE_EXPECT(count <= widest_lanes());
#if defined(__x86_64__)
  if (count == LaneCount::Sixteen) return call(std::integral_constant<int, 16>{});
  if (count == LaneCount::Eight) return call(std::integral_constant<int, 8>{});
#endif
  if (count == LaneCount::Four) return call(std::integral_constant<int, 4>{});
  return call(std::integral_constant<int, 1>{});
}

}  // namespace dismantle
