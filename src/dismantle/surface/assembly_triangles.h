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

/// The triangles of a whole assembly as streams, with the hierarchy over them: what stays the same from step to step.
/// Triangles are in the hierarchy's leaf order and vertices in the order of their first use by it, so that neighbours
/// in space are neighbours in memory. A component's triangles and vertices are one range each.
struct AssemblyTriangles {
  std::vector<Vec3> vertices;               ///< S_v0: in the assembled state [mm, assembly frame].
  std::vector<std::uint32_t> vertex_begin;  ///< Shape [component_count + 1].
  std::vector<Face> faces;                  ///< Vertex indices of each leaf's triangle.
  std::vector<FaceId> face_of;              ///< Of each leaf: the face of its component's own mesh.
  std::vector<std::uint8_t> features;       ///< Of each leaf: representative_features of its component's mesh.
  Bvh bvh;
  BvhRefitPlan refit_plan;

  std::size_t component_count() const { return bvh.components.size(); }
  Span<const Vec3> vertices_of(ComponentId c) const {
    return Span<const Vec3>(vertices).subspan(vertex_begin[c.value], vertex_begin[c.value + 1] - vertex_begin[c.value]);
  }
};

/// Lays out the streams and builds the hierarchy in the assembled state. The result depends on the assembly alone.
/// @pre fewer than 2^31 triangles
AssemblyTriangles make_assembly_triangles(const Assembly& assembly, const Executor& executor);

/// Bounds of all nodes at one moment, leaves grown by `margin` [mm]: two triangles nearer than twice the margin have
/// overlapping bounds.
/// @param vertices at that moment, in the streams' order
std::vector<Kdop16> bounds_at(const AssemblyTriangles& streams, Span<const Vec3> vertices, double margin,
                              const Executor& executor);

}  // namespace dismantle
