// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/vertex_tree.h"
#include "dismantle/core/id.h"
#include "dismantle/surface/solid_tree_query.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The side of a closed surface on which a point lies.
enum class SurfaceSide : std::uint8_t { Unknown, Inside, Outside };

/// The vertices in one sphere, with the bounds that are known of them.
struct WatchedSphere {
  VertexNode node;                          ///< The vertices.
  std::uint32_t face = NearestFace::kNone;  ///< The outer component's nearest face at the last evaluation.
  SurfaceSide side = SurfaceSide::Unknown;  ///< Side of the sphere's center at the last evaluation.
  double slack = -1;  ///< Lower bound of `limit` less depth for every vertex, reduced by the paths since then [mm].
  double clear = 0;   ///< Lower bound of the center's distance to the surface, reduced by the paths since then [mm].

  /// The bounds that remain after a motion. @param path upper bound of the path of every point of the sphere [mm]
  WatchedSphere after(double path) const;
};

/// The vertices of one component against the surface of another closed one. The slack of a vertex is the depth by which
/// it may still get deeper.
struct WatchedComponent {
  ComponentId inner;                       ///< The component with the vertices.
  ComponentId outer;                       ///< The component with the surface.
  const SolidTree* solid_inner = nullptr;  ///< Faces of `inner`.
  const SolidTree* solid_outer = nullptr;  ///< Faces of `outer`.
  const VertexTree* tree = nullptr;        ///< Vertices of `inner`.
  double limit = 0;                        ///< Allowed depth of a vertex [mm].
  double resolution = 0;                   ///< Slacks below this count as used up [mm].

  std::vector<WatchedSphere> spheres;      ///< In the order of the tree; together they hold all vertices.
  double path = 0;                         ///< Upper bound of the paths since the bounds in `spheres` [mm].
  double min_slack = -1;                   ///< Smallest slack in `spheres` [mm].
  std::vector<WatchedSphere> spheres_end;  ///< At the end of the last sweep; empty if `spheres` remain valid.
  double path_end = 0;                     ///< `path` at the end of the last sweep [mm].

  /// The sphere around the vertices of a node [mm, assembled state of `inner`].
  VertexSphere sphere(const VertexNode& node) const { return tree->sphere(node, solid_inner->vertices); }
  /// Forgets all bounds: one sphere of all vertices remains, of which nothing is known.
  void restart();
  /// Takes new spheres, whose bounds are those of the present state.
  void set_spheres(std::vector<WatchedSphere> now);
  /// Makes the end of the last sweep the present state.
  void commit();
};

}  // namespace dismantle
