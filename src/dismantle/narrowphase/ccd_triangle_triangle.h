// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_result.h"

namespace dismantle {

/// The certified test of a whole triangle pair (DESIGN section 4): conservative advancement along a separating axis.
/// Linear vertex paths. With depth = the least translation that parts the triangles (0 where they are apart):
///   1. Free is certain: at no instant are the triangles deeper in each other than `allowed`, despite rounding.
///   2. Contact: the motion is certainly allowed on [0, toi]; toi is 0 where they are too deep at the start.
///   3. With allowed = 0, touching counts as contact (closed sets).
/// @param allowed penetration that is allowed [mm], >= 0
DISMANTLE_HOST_DEVICE CcdResult ccd_triangle_triangle(const TriangleMotion& a, const TriangleMotion& b, double allowed);

}  // namespace dismantle
