// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

namespace dismantle {

/// A triangle, counter-clockwise seen from outside.
struct Triangle {
  Vec3 corner[3];  ///< [mm]

  ///@{ A corner. @param i 0 to 2
  DISMANTLE_HOST_DEVICE Vec3& operator[](int i) { return corner[i]; }
  DISMANTLE_HOST_DEVICE const Vec3& operator[](int i) const { return corner[i]; }
  ///@}
  /// True if the corners are equal, in the same order.
  DISMANTLE_HOST_DEVICE friend bool operator==(const Triangle& a, const Triangle& b) {
    return a.corner[0] == b.corner[0] && a.corner[1] == b.corner[1] && a.corner[2] == b.corner[2];
  }
};

/// The outward normal; its length is twice the area [mm^2].
DISMANTLE_HOST_DEVICE inline Vec3 normal_unscaled(const Triangle& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

}  // namespace dismantle
