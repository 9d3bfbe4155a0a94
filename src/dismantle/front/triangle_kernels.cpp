// SPDX-License-Identifier: Apache-2.0
#include "dismantle/front/triangle_lanes.h"

namespace dismantle {

template <>
void separate_triangles_kernel<DISMANTLE_LANE_COUNT>(const TrianglePairQuery* queries, std::size_t count,
                                                     const LinearSweep& sweep, NodeSeparation* separations) {
  constexpr std::size_t kLanes = DISMANTLE_LANE_COUNT;
  for (std::size_t first = 0; first < count; first += kLanes)
    separate_triangle_lanes<DISMANTLE_LANE_COUNT>(queries + first, count - first, sweep, separations + first);
}

}  // namespace dismantle
