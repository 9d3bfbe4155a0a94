// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

namespace dismantle {

/// An oriented box in float32: the points center + t0 axis[0] + t1 axis[1] + t2 third_axis() with |ti| <= half[i].
/// The axes are of unit length and at right angles up to float rounding; the set above is what counts, not an ideal
/// box. Lengths in mm, frame of its owner.
struct Obb {
  Vec3f center;
  Vec3f axis[2] = {{1, 0, 0}, {0, 1, 0}};
  Vec3f half;  ///< Half edge lengths, >= 0.

  DISMANTLE_HOST_DEVICE Vec3f third_axis() const { return cross(axis[0], axis[1]); }
};

}  // namespace dismantle
