// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/aabb.h"

#include <vector>

namespace dismantle {

/// The eight corners of a box; bits 0, 1 and 2 of the index are set for the upper x, y and z.
inline std::vector<Vec3> corners_of(const Aabb& box) {
  std::vector<Vec3> corners(8);
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                  i & 4 ? box.upper.z : box.lower.z};
  return corners;
}

}  // namespace dismantle
