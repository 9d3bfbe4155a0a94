// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

namespace dismantle {

/// How deep two intersecting triangles are in each other.
struct Penetration {
  double depth = 0;  ///< Length of the least translation that parts them; 0 where apart or only touching [mm].
  Vec3 axis;         ///< Unit direction: translating `b` by depth * axis parts them; zero where depth is 0.
};

/// The depth of two triangles: distance from the origin to the boundary of their Minkowski difference, over its 11
/// facet normals (2 face normals, 9 edge cross products); coplanar triangles have depth 0. Within
/// kPenetrationRelativeError of the exact value, relative to the largest coordinate difference.
DISMANTLE_HOST_DEVICE Penetration penetration_triangle_triangle(const Triangle& a, const Triangle& b);

}  // namespace dismantle
