// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/sweep_triangles.h"
#include "dismantle/core/span.h"

#include <vector>

namespace dismantle::audit {

/// The motion of one component's vertices relative to another, closed component.
struct VertexSweep {
  ///@{ The closed component and that of the vertices; never null.
  const AuditBody* solid = nullptr;
  const AuditBody* points = nullptr;
  ///@}
  double limit = 0;  ///< Largest allowed depth of a vertex [mm].
  ///@{ As in PairSweep.
  double resolution = 0;
  double rounding = 0;
  ///@}
  ///@{ Segments [first_active, end) are checked.
  std::uint32_t first_active = 0;
  std::uint32_t end = 0;
  ///@}
  std::vector<RelativeMotion> motions;  ///< Of `points` relative to `solid` in each segment of the move.
};

/// The findings about one vertex.
struct VertexFindings {
  Breach breach;            ///< Of rule 2.
  bool tracked = false;     ///< It may be inside at the end, and has to be followed further.
  std::size_t samples = 0;  ///< Number of distances evaluated.
};

/// Checks rule 2 of the guarantee for a vertex in the segments in which it may be inside: those in which the triangle
/// sweep found that it may cross the surface, and those that follow until it is outside. The depth is the distance from
/// the surface. Between samples it is certainly outside, or within the limit plus half the resolution of the surface.
/// Ends at the first breach.
/// @param tracked true if it may be inside at the start
/// @param crossings of this vertex, ordered by segment
VertexFindings sweep_vertex(const VertexSweep& sweep, std::uint32_t vertex, bool tracked,
                            Span<const CrossingVertex> crossings);

/// The vertices inside a solid at the start of a segment.
struct InsideVertices {
  std::vector<std::uint32_t> vertices;  ///< Ascending.
  Breach breach;                        ///< The largest depth, if it is above the limit.
  std::size_t samples = 0;              ///< Number of distances evaluated.
};
/// Finds the vertices inside the solid at the start of a segment.
InsideVertices find_inside_vertices(const VertexSweep& sweep, std::uint32_t segment);

}  // namespace dismantle::audit
