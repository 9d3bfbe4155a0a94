// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/sweep_triangles.h"
#include "dismantle/core/span.h"

#include <vector>

namespace dismantle::audit {

/// Vertices of one component against the inside of another, closed one.
struct VertexSweep {
  const AuditBody* solid = nullptr;
  const AuditBody* points = nullptr;
  double limit = 0;       ///< How deep a vertex may be inside [mm].
  double resolution = 0;  ///< As in PairSweep.
  double rounding = 0;
  std::uint32_t first_active = 0;  ///< Segments before this one, and from `end` on, are not looked at.
  std::uint32_t end = 0;
  std::vector<RelativeMotion> motions;  ///< Of `points` seen from `solid`, one a segment of the move.
};

/// What became of one vertex.
struct VertexFindings {
  Breach breach;
  bool tracked =
      false;  ///< At the end it may be inside: it must be followed on, whether it crosses the surface or not.
  std::size_t samples = 0;
};

/// Follows a vertex through the segments in which it may be inside: those in which the triangle sweep says that it may
/// cross the surface, and those after which it was not seen outside. Rule 2 of the guarantee: the depth is the distance
/// to the surface. Between samples it is certain to be outside, or within the limit (and half a resolution) of the
/// surface. Stops at the first breach.
/// @param tracked whether it may be inside at the start
/// @param crossings of this vertex, ordered by segment
VertexFindings sweep_vertex(const VertexSweep& sweep, std::uint32_t vertex, bool tracked,
                            Span<const CrossingVertex> crossings);

/// The vertices that lie inside the solid at the start of a segment, with the deepest of them if that is deeper
/// than the limit.
struct InsideVertices {
  std::vector<std::uint32_t> vertices;
  Breach breach;
  std::size_t samples = 0;
};
InsideVertices find_inside_vertices(const VertexSweep& sweep, std::uint32_t segment);

}  // namespace dismantle::audit
