// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/bvh/radial_bounds.h"
#include "dismantle/exec/executor.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dismantle {

/// A component's triangles in the assembled state with their OBB tree, normals and surfaces of revolution: the shape
/// that the method `certificates` and the queries of solid_tree_query.h and solid_distance.h work on.
struct SolidTree {
  std::vector<Vec3> vertices;  ///< Positions in the assembled state [mm, assembly frame].
  Span<const Face> faces;      ///< Of the component's mesh.
  /// The mesh bounds a volume and its normals point outwards (MeshFaults::bounds_solid). The next three arrays are
  /// empty where not.
  bool has_outside = false;
  /// The mesh bounds a volume, but its normals point inwards.
  bool inside_out = false;
  Span<const Vec3> normals;                ///< Unit outward normal of each face.
  Span<const std::uint32_t> around_begin;  ///< Begin of each vertex's range in `around`, shape [vertex_count + 1].
  Span<const std::uint32_t> around;        ///< Faces at each vertex.
  ObbTree tree;                            ///< Boxes over the faces.
  std::unique_ptr<const RevolutionSurface> revolution;  ///< Its surfaces of revolution; null where it has no faces.
  /// The arrays that the spans above refer to; ghost surfaces share them with their component.
  struct FaceNormals;
  std::shared_ptr<const FaceNormals> face_normals;  ///< Null where the spans are empty.

  /// A face's triangle in the assembled state [mm].
  Triangle triangle(std::uint32_t face) const {
    const Face& f = faces[face];
    return {{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}};
  }
};

/// The normals of a solid's faces, and the faces at its vertices.
struct SolidTree::FaceNormals {
  std::vector<Vec3> normals;                ///< As SolidTree has them.
  std::vector<std::uint32_t> around_begin;  ///< As SolidTree has them.
  std::vector<std::uint32_t> around;        ///< As SolidTree has them.
};

/// Builds the tree of a component. The result depends on the component alone.
/// @param component must outlive the tree, which refers to the faces of its mesh
SolidTree make_solid_tree(const Component& component, const Executor& executor);

/// The tree of a component with other positions of its vertices [mm, assembled]; normals and surfaces of revolution are
/// recognised in the component as it is.
SolidTree make_displaced_tree(const SolidTree& solid, std::vector<Vec3> vertices, const Executor& executor);

}  // namespace dismantle
