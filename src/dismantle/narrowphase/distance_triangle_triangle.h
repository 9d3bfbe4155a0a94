// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

namespace dismantle {

/// The closest points of two triangles.
struct TriangleDistance {
  double distance = 0;  ///< 0 where they intersect [mm].
  Vec3 point_a, point_b;
};

/// Distance and closest points of two triangles (6 vertex-face, 9 edge-edge, intersection). Robust for degenerate
/// input; accurate to rounding relative to the largest coordinate difference.
DISMANTLE_HOST_DEVICE TriangleDistance distance_triangle_triangle(const Triangle& a, const Triangle& b);

}  // namespace dismantle
