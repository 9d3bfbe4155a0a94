// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/bvh/bvh.h"
#include "dismantle/bvh/bvh_refit.h"
#include "dismantle/exec/executor.h"
#include "dismantle/geometry/kdop.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The triangles of a whole assembly in the assembled state and the one BVH over them: the data that stay the same from
/// step to step. Triangles are in the leaf order of the BVH and vertices in the order of their first use by it, so that
/// neighbours in space are neighbours in memory. A component's triangles and vertices are one range each.
struct AssemblyTriangles {
  std::vector<Vec3> vertices;               ///< S_v0: positions in the assembled state [mm, assembly frame].
  std::vector<std::uint32_t> vertex_begin;  ///< First vertex of each component, shape [component_count + 1].
  std::vector<Face> faces;                  ///< Vertex indices of the triangle of each leaf.
  std::vector<FaceId> face_of;              ///< Face of each leaf in the mesh of its component.
  std::vector<std::uint8_t> features;       ///< representative_features of each leaf's triangle in that mesh.
  Bvh bvh;                                  ///< Topology only: bounds depend on the time (bounds_at()).
  BvhRefitPlan refit_plan;                  ///< Order in which bounds are refitted.

  /// Number of components, those without triangles included.
  std::size_t component_count() const { return bvh.components.size(); }
  /// Vertices of a component in the assembled state [mm].
  Span<const Vec3> vertices_of(ComponentId c) const {
    return Span<const Vec3>(vertices).subspan(vertex_begin[c.value], vertex_begin[c.value + 1] - vertex_begin[c.value]);
  }
};

/// Sorts the triangles and builds the BVH in the assembled state. The result depends on the assembly alone.
/// @pre fewer than 2^31 triangles
AssemblyTriangles make_assembly_triangles(const Assembly& assembly, const Executor& executor);

/// Bounds of all nodes at one time, leaves grown by `margin` [mm]: two triangles nearer than twice the margin have
/// overlapping bounds.
/// @param vertices positions at that time [mm], in the order of `triangles.vertices`
std::vector<Kdop16> bounds_at(const AssemblyTriangles& triangles, Span<const Vec3> vertices, double margin,
                              const Executor& executor);

}  // namespace dismantle
