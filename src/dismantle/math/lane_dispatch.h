// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/contract.h"
#include "dismantle/core/span.h"

#include <type_traits>

namespace dismantle {

/// The number of lanes of a kernel (math/lanes.h).
enum class LaneCount : int {
  One = 1,       ///< The scalar reference, on every machine.
  Four = 4,      ///< On every machine.
  Eight = 8,     ///< With AVX2.
  Sixteen = 16,  ///< With AVX-512 (F, BW, DQ and VL).
};

/// The counts that this machine can run, in ascending order.
Span<const LaneCount> lane_counts();

/// The largest of lane_counts().
LaneCount widest_lanes();

/// Calls `call` with the count as a constant (std::integral_constant<int, 8>, which converts to int in constant
/// expressions), so that it can name the kernel of that width. @return the result of the call
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
