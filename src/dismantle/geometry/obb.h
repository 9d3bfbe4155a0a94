// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

namespace dismantle {

/// An oriented box in float32: the points center + t0 axis[0] + t1 axis[1] + t2 third_axis() with |ti| <= half[i].
/// The axes are of unit length and at right angles up to float rounding only; the box is defined by the formula, with
/// the axes as they are. Frame of its owner.
struct Obb {
  Vec3f center;                            ///< [mm]
  Vec3f axis[2] = {{1, 0, 0}, {0, 1, 0}};  ///< Unit, at right angles.
  Vec3f half;                              ///< Half edge lengths, >= 0 [mm].

  /// The third axis, which is not stored.
  DISMANTLE_HOST_DEVICE Vec3f third_axis() const { return cross(axis[0], axis[1]); }
};

}  // namespace dismantle
