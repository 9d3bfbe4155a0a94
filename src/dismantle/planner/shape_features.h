// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/planner/search/direction_clusters.h"

#include <vector>

namespace dismantle {

/// What a shape has of its own, in whatever orientation it is given.
struct ShapeFeatures {
  std::vector<WeightedDirection> normals;  ///< Of its plane faces, the largest first; weights are areas [mm^2].
  std::vector<WeightedDirection> axes;  ///< Of what is round or goes straight on, of either sign; the heaviest first.
  Vec3 center;                          ///< The mean of its vertices [mm].
  double radius = 0;                    ///< Of the sphere about the center that holds it [mm].
  double area = 0;                      ///< Of its surface, whatever triangles it is cut into [mm^2].
};

/// Finds the plane faces, and the axes of bores, shafts, ribs and all else that is swept along a line: two faces that
/// meet at an angle are swept along the cross product of their normals, and around a bore all agree.
ShapeFeatures shape_features(const TriangleMesh& mesh);

}  // namespace dismantle
