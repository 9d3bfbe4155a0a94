// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

namespace dismantle {

/// Where two triangles lie over each other, seen along a direction, and how far apart they are there.
struct ContactPatch {
  static constexpr int kMaxPoints = 15;
  struct Point {
    Vec3 on_upper;   ///< [mm]
    double gap = 0;  ///< From the lower triangle up to it, along the direction [mm].
  };
  Point points[kMaxPoints];
  int count = 0;

  /// The least gap; only where count > 0.
  const Point& nearest() const;
};

/// The corners of the part that both triangles cover when seen along the unit vector `up`: corners of either over the
/// other, and crossings of their edges. As both are flat, gaps in between are no less than at these.
/// @param slack corners and crossings count that are outside by at most this [mm]
ContactPatch contact_patch(const Triangle& upper, const Triangle& lower, Vec3 up, double slack);

}  // namespace dismantle
