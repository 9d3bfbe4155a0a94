// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <vector>

namespace dismantle::audit {

/// A straight part of the boundary of a surface, in the direction in which the surface's faces run along it.
struct OpenEdge {
  Vec3 from;         ///< Its begin [mm].
  Vec3 to;           ///< Its end [mm].
  double count = 0;  ///< How many more faces run along it in this direction than in the other; positive.
};

/// Vertices and edges of the boundary that are no further apart than this part of the mesh's diagonal are the same:
/// what lies between is a crack, not an opening.
inline constexpr double kCrackWidth = 1e-4;

/// The boundary of a surface as a chain of edges: where faces do not cancel each other. Edges that have vertices of
/// others in between (T-junctions) are cut there, so that cracks cancel. Empty for a surface that is closed up to
/// cracks, in either orientation.
std::vector<OpenEdge> open_boundary(const TriangleMesh& mesh);

/// The solid angle at `point` of the strip from an edge to infinity along the unit vector `direction` [sr]; positive
/// where the triangle (from, to, infinity) is clockwise seen from the point.
double strip_angle(const OpenEdge& edge, Vec3 direction, Vec3 point);

/// The sum of the solid angles of the strips of several edges [sr], with one arctangent.
double strip_angles(const std::vector<OpenEdge>& edges, Vec3 direction, Vec3 point);

}  // namespace dismantle::audit
