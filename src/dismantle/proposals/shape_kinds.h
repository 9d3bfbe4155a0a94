// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <optional>

namespace dismantle {

/// A ring, closed or open, by the places of its vertices.
struct RingShape {
  Vec3 center;            ///< [mm]
  Vec3 axis;              ///< Unit, of either sign.
  double inner = 0;       ///< Inner radius [mm].
  double outer = 0;       ///< Outer radius [mm].
  double height = 0;      ///< Along the axis [mm].
  double gap = 0;         ///< Largest angle about the axis without a vertex [rad].
  bool is_torus = false;  ///< All vertices are on a torus.
};

/// The ring that a mesh is; nothing if it is none: its surface comes nowhere within half its outer radius of the axis,
/// and its vertices go around it, but for one gap.
std::optional<RingShape> ring_shape(const TriangleMesh& mesh);

/// True if a ring is open and as flat and narrow as circlips are.
bool is_circlip(const RingShape& ring);

/// A ball by the places of its vertices.
struct BallShape {
  Vec3 center;        ///< [mm]
  double radius = 0;  ///< [mm]
};

/// The ball that a mesh is; nothing if it is none.
std::optional<BallShape> ball_shape(const TriangleMesh& mesh);

/// The lengths of a box along the principal axes of a mesh's surface, ascending [mm]; zero for an empty mesh.
Vec3 principal_lengths(const TriangleMesh& mesh);

/// Four times the volume over the area: the diameter of a long wire, whatever its way [mm]; 0 for what is no solid.
double section_of(const TriangleMesh& mesh);

}  // namespace dismantle
