// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

namespace dismantle {

/// True where the closed triangles share a point (touching counts). Exact for every finite double input, degenerate
/// triangles included: Devillers and Guigue's orientation signs (INRIA RR-4488; Du et al. 2015, algorithm 2) with the
/// coplanar case, the signs by a floating-point filter and then by exact arithmetic.
DISMANTLE_HOST_DEVICE bool intersect_triangle_triangle(const Triangle& a, const Triangle& b);

}  // namespace dismantle
