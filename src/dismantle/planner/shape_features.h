// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/bvh/sphere_tree.h"
#include "dismantle/core/span.h"
#include "dismantle/exec/executor.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/planner/search/direction_clusters.h"

#include <vector>

namespace dismantle {

/// Characteristic directions and size of a shape, independent of its orientation.
struct ShapeFeatures {
  std::vector<WeightedDirection> normals;  ///< Normals of plane faces, the largest first; weights are areas [mm^2].
  std::vector<WeightedDirection>
      axes;           ///< Axes of surfaces of revolution and extrusions, of either sign; the heaviest first.
  Vec3 center;        ///< The mean of its vertices [mm].
  double radius = 0;  ///< Of its bounding sphere about the center [mm].
  double area = 0;    ///< Surface area [mm^2]; independent of the tessellation.
  Aabb bounds;        ///< Its bounding box [mm].
};

/// Finds plane faces, and the axes of bores, shafts, ribs and other extruded shapes: two faces that meet at an angle
/// share the direction of the cross product of their normals, and around a bore all of these agree.
ShapeFeatures shape_features(const TriangleMesh& mesh);
/// The features of all assembled components of an assembly.
std::vector<ShapeFeatures> shape_features(const Assembly& assembly, const Executor& executor);

/// The tree of the bounding spheres of all components; each is known by its index.
SphereTree sphere_tree(Span<const ShapeFeatures> features);

}  // namespace dismantle
