// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/lane_dispatch.h"

namespace dismantle {

namespace {

constexpr LaneCount kCounts[] = {LaneCount::One, LaneCount::Four, LaneCount::Eight, LaneCount::Sixteen};

std::size_t supported_counts() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2")) return 2;
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return avx512 ? 4 : 3;
#else
  return 2;
#endif
}

}  // namespace

Span<const LaneCount> lane_counts() {
  static const std::size_t count = supported_counts();
  return {kCounts, count};
}

LaneCount widest_lanes() {
  const Span<const LaneCount> counts = lane_counts();
  return counts[counts.size() - 1];
}

}  // namespace dismantle
