// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

namespace dismantle {

/// Corners of the overlap of two triangles seen along a direction, and the gaps there.
struct ContactPatch {
  static constexpr int kMaxPoints = 15;  ///< Six corners and nine crossings of edges.
  /// A corner of the overlap.
  struct Point {
    Vec3 on_upper;   ///< On the upper triangle [mm].
    double gap = 0;  ///< From the lower to the upper triangle along the direction [mm].
  };
  Point points[kMaxPoints];  ///< The first `count` are valid.
  int count = 0;             ///< Number of points.

  /// The point of the smallest gap. @pre count > 0
  const Point& nearest() const;
};

/// The overlap of two triangles seen along the unit vector `up`: corners of either over the other, and crossings of
/// their edges. As both are flat, gaps in between are no smaller than at these.
/// @param slack corners and crossings outside by at most this count as well [mm]
ContactPatch contact_patch(const Triangle& upper, const Triangle& lower, Vec3 up, double slack);

}  // namespace dismantle
