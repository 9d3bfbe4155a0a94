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
  std::size_t boundary = 0;     ///< Edges of one face.
  std::size_t nonmanifold = 0;  ///< Edges of more than two faces.
  std::size_t misoriented = 0;  ///< Edges that their two faces run along in the same direction.
  /// Edges that the surface does not run along equally often in both directions, less those that are only one side of a
  /// crack: others of these edges run along them in the opposite direction within rounding, as at T-junctions and
  /// missing slivers. If there are none, the surface encloses a volume up to cracks.
  std::size_t open = 0;
};

/// Counts the faults of a mesh.
EdgeFaults edge_faults(const TriangleMesh& mesh);

/// Two faces and the edge that only they share.
struct NeighbouringFaces {
  std::uint32_t face[2];  ///< In ascending order.
  std::uint32_t edge[2];  ///< Its vertices.
};

/// All edges of exactly two faces.
std::vector<NeighbouringFaces> neighbouring_faces(Span<const Face> faces);

/// Assigns every used vertex and every edge to exactly one of its triangles, so that it is tested once only
/// (representative triangles, Curtis, Tamstorf, Manocha 2008).
/// @return the features of each triangle, shape [face_count]. Bit k (0-2): its corner k; bit 3+k: its edge from corner
/// k to corner (k+1)%3
std::vector<std::uint8_t> representative_features(const TriangleMesh& mesh);

}  // namespace dismantle
