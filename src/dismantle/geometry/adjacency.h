// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/core/span.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Counts of edges that keep a mesh from being a closed, consistently oriented surface.
struct EdgeFaults {
  std::size_t boundary = 0;
  std::size_t nonmanifold = 0;
  std::size_t misoriented = 0;
  /// Edges at which the oriented surface really ends: those that it does not run along as often one way as the other,
  /// less those that others of these run along the other way, as where a vertex of one face lies on the edge of the
  /// next, or a sliver is missing. With none the surface encloses a volume, but for cracks of next to no width.
  std::size_t open = 0;
};

EdgeFaults edge_faults(const TriangleMesh& mesh);

/// Two faces and the edge that they alone share.
struct NeighbouringFaces {
  std::uint32_t face[2];
  std::uint32_t edge[2];  ///< Its vertices.
};

/// Every edge of exactly two faces.
std::vector<NeighbouringFaces> neighbouring_faces(Span<const Face> faces);

/// Which of its features a triangle stands for, so that every vertex and edge is tested once though several triangles
/// share it (representative triangles, Curtis, Tamstorf, Manocha 2008). Bit k (0-2): its corner k; bit 3+k: its edge
/// from corner k to corner (k+1)%3. Every used vertex and every edge has exactly one triangle that stands for it. Shape
/// [face_count].
std::vector<std::uint8_t> representative_features(const TriangleMesh& mesh);

}  // namespace dismantle
