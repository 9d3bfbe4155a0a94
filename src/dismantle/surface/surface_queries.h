// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/surface/assembly_triangles.h"
#include "dismantle/surface/moving_surface.h"

#include <vector>

namespace dismantle {

/// The assembled state with its hierarchy: what questions about components' surfaces are asked of.
struct AssemblySurface {
  AssemblyTriangles streams;
  std::vector<Kdop16> bounds;  ///< Of each node, without margin.

  Triangle leaf_triangle(NodeIndex leaf) const {
    const Face& f = streams.faces[leaf];
    return {{streams.vertices[f.v[0]], streams.vertices[f.v[1]], streams.vertices[f.v[2]]}};
  }
  /// As solid queries take it.
  MomentaryTriangles assembled() const {
    return {&streams, {streams.vertices, streams.vertices, streams.faces}, bounds, 0};
  }
  /// kNoNode for a component without triangles.
  NodeIndex root_of(ComponentId component) const { return streams.bvh.components[component.value].root; }
};

AssemblySurface make_assembly_surface(const Assembly& assembly, const Executor& executor);

/// Pairs of components whose bounds come within `margin` [mm] of each other (a superset), a < b, ordered.
std::vector<std::pair<ComponentId, ComponentId>> near_component_pairs(const AssemblySurface& surface, double margin,
                                                                      const Executor& executor);

/// How two components' surfaces meet.
struct SurfaceOverlap {
  std::size_t triangle_pairs = 0;    ///< That intersect; touching counts.
  double penetration = 0;            ///< The largest depth of one of them [mm].
  std::vector<NodeIndex> leaves[2];  ///< Leaves of either component that intersect the other: sorted, each once.
};

SurfaceOverlap surface_overlap(const AssemblySurface& surface, ComponentId a, ComponentId b);

/// The least distance of two components' surfaces [mm]; `limit` where it is not below that.
double surface_distance(const AssemblySurface& surface, ComponentId a, ComponentId b, double limit);

/// The distance from a point to the component's surface [mm], and the leaf of the nearest triangle.
struct SurfaceDistance {
  double distance = 0;
  NodeIndex leaf = kNoNode;
};
SurfaceDistance surface_distance(const AssemblySurface& surface, ComponentId component, Vec3 point);

/// The depth of the deepest vertex of `inner` inside `outer` [mm]: its distance to the surface of `outer`; 0 where none
/// is inside. `crossing` are the leaves of `inner` that intersect `outer` (surface_overlap): vertices that are joined
/// by other triangles are all inside or all outside, so that one ray a region is enough.
/// @pre `outer` is closed
double deepest_vertex(const AssemblySurface& surface, ComponentId inner, ComponentId outer,
                      const std::vector<NodeIndex>& crossing);

}  // namespace dismantle
