// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/exec/executor.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The point of a triangle that is nearest to `point`. Robust for slivers and degenerate triangles: the point returned
/// is always one of the triangle, up to rounding, and nearest to within rounding.
Vec3 closest_point_of_triangle(const Triangle& triangle, Vec3 point);

/// Distance from a point to a mesh, and a triangle at that distance.
struct MeshDistance {
  double distance = 0;     ///< [mm]
  std::uint32_t face = 0;  ///< Of the mesh.
};

/// Answers how far points are from a mesh. Keeps a copy of its triangles.
class SurfaceTree {
 public:
  /// @pre the mesh has a triangle
  explicit SurfaceTree(const TriangleMesh& mesh, const Executor& executor = {});

  /// The distance from `point` to the mesh: to the point of its triangles that is nearest, exact up to rounding.
  /// @param hint a triangle that may be near: the better it is, the sooner the answer
  MeshDistance distance(Vec3 point, std::uint32_t hint = 0) const;
  const Triangle& triangle(std::uint32_t face) const { return triangles_[face]; }
  /// The distance from `point` to one triangle [mm].
  double distance_to_face(Vec3 point, std::uint32_t face) const;

 private:
  Bvh bvh_;
  std::vector<Aabb> boxes_;          // of each node
  std::vector<Triangle> triangles_;  // of the mesh
};

}  // namespace dismantle
