// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/exec/executor.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Distance of a point from a mesh and a triangle at that distance.
struct MeshDistance {
  double distance = 0;     ///< [mm]
  std::uint32_t face = 0;  ///< The triangle.
};

/// Distances of points from a mesh in its own frame, by branch and bound over a BVH of boxes in double. Keeps a copy of
/// its triangles.
class SurfaceTree {
 public:
  /// Builds the tree; the same one on every executor. @pre the mesh has a triangle
  explicit SurfaceTree(const TriangleMesh& mesh, const Executor& executor = {});

  /// The distance from `point` to the mesh, exact up to the rounding of closest_point_of_triangle().
  /// @param hint a triangle to start from: the nearer, the fewer nodes are visited
  MeshDistance distance(Vec3 point, std::uint32_t hint = 0) const;
  /// A triangle of the mesh.
  const Triangle& triangle(std::uint32_t face) const { return triangles_[face]; }
  /// The distance from `point` to one triangle [mm].
  double distance_to_face(Vec3 point, std::uint32_t face) const;

 private:
  Bvh bvh_;
  std::vector<Aabb> boxes_;          // of each node
  std::vector<Triangle> triangles_;  // of the mesh
};

}  // namespace dismantle
