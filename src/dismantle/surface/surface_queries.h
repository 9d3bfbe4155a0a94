// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/surface/assembly_triangles.h"
#include "dismantle/surface/moving_surface.h"

#include <vector>

namespace dismantle {

/// The surfaces of all components in the assembled state, with the BVH of AssemblyTriangles.
///
/// Classification of pairs, once a load, works on this tree, queries during motion on SolidTree: the latter takes 5 to
/// 8 times as long to build, which is more than classification as a whole.
struct AssemblySurface {
  AssemblyTriangles triangles;  ///< In the assembled state.
  std::vector<Kdop16> bounds;   ///< Of each node, without margin.

  /// The triangle of a leaf [mm, assembly frame].
  Triangle leaf_triangle(NodeIndex leaf) const {
    const Face& f = triangles.faces[leaf];
    return {{triangles.vertices[f.v[0]], triangles.vertices[f.v[1]], triangles.vertices[f.v[2]]}};
  }
  /// The triangles at rest, as point_in_component() takes them.
  MomentaryTriangles assembled() const {
    return {&triangles, {triangles.vertices, triangles.vertices, triangles.faces}, bounds, 0};
  }
  /// Root node of a component; kNoNode for one without triangles.
  NodeIndex root_of(ComponentId component) const { return triangles.bvh.components[component.value].root; }
};

/// Builds the surfaces of an assembly. The result depends on the assembly alone.
AssemblySurface make_assembly_surface(const Assembly& assembly, const Executor& executor);

/// Pairs of components whose bounds come within `margin` [mm] of each other (a superset), a < b, ordered.
std::vector<std::pair<ComponentId, ComponentId>> near_component_pairs(const AssemblyTriangles& triangles, double margin,
                                                                      const Executor& executor);

/// The intersection of two components' surfaces.
struct SurfaceOverlap {
  std::size_t triangle_pairs = 0;    ///< Number of triangle pairs that intersect; touching counts.
  double penetration = 0;            ///< Largest depth of a triangle pair [mm].
  std::vector<NodeIndex> leaves[2];  ///< Leaves of `a` and of `b` that intersect the other: sorted, each once.
};

/// All intersecting triangle pairs of two components, by exact predicates. @pre a < b
SurfaceOverlap surface_overlap(const AssemblySurface& surface, ComponentId a, ComponentId b);

/// The distance of two surfaces and a nearest point of the first one.
struct SurfaceDistance {
  double distance = 0;  ///< [mm]
  Vec3 point;           ///< [mm, assembly frame]; the origin where nothing below the limit was found.
};

/// The distance of two components' surfaces, at most `limit` [mm]. As exact as distance_triangle_triangle().
/// @param accept_below of surfaces that do not meet, the distance may be any below this [mm] if the true one is
SurfaceDistance nearest_of_surface(const AssemblySurface& surface, ComponentId a, ComponentId b, double limit,
                                   double accept_below = 0);

/// The distance of nearest_of_surface() [mm].
double surface_distance(const AssemblySurface& surface, ComponentId a, ComponentId b, double limit);

/// The distance from a point to the component's surface [mm], up to the rounding of closest_points_vertex_face();
/// infinite for a component without triangles.
double surface_distance(const AssemblySurface& surface, ComponentId component, Vec3 point);

/// The depth of the deepest vertex of `inner` inside `outer` [mm]: its distance to the surface of `outer`; 0 where no
/// vertex is inside. Vertices that triangles connect which do not intersect `outer` are all inside or all outside, so
/// that one inside test per region is enough.
/// @param crossing the leaves of `inner` that intersect `outer` (surface_overlap()), sorted
/// @pre `outer` is closed
double deepest_vertex(const AssemblySurface& surface, ComponentId inner, ComponentId outer,
                      const std::vector<NodeIndex>& crossing);

}  // namespace dismantle
