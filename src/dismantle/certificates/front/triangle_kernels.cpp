// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/triangle_lanes.h"

namespace dismantle {

template <>
void separate_triangles_kernel<DISMANTLE_LANE_COUNT>(const TrianglePairQuery* queries, std::size_t count,
                                                     const LinearSweep& sweep, NodeSeparation* separations) {
  separate_triangle_lanes<DISMANTLE_LANE_COUNT>(queries, count, sweep, separations);
}

}  // namespace dismantle
