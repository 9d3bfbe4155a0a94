// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dismantle {

/// One side of a face, as one of the half edges that make up an edge of the mesh.
struct HalfEdge {
  std::uint32_t low;   ///< The vertex of the edge with the smaller index.
  std::uint32_t high;  ///< The other vertex of the edge.
  std::uint32_t face;  ///< Index of the face.
  std::uint8_t side;   ///< From the face's corner `side` to the next one.
  bool forward;        ///< Runs from low to high.
};

/// The half edges of all faces, sorted by low, high, face and side: those of one edge are together. Shape [3
/// face_count].
std::vector<HalfEdge> sorted_half_edges(Span<const Face> faces);

/// Calls visit(first, last) for each edge: the range of its half edges.
/// @param half_edges as sorted_half_edges gives them
template <class Visit>
void for_each_edge(const std::vector<HalfEdge>& half_edges, Visit visit) {
  for (std::size_t i = 0; i < half_edges.size();) {
    std::size_t j = i + 1;
    while (j < half_edges.size() && half_edges[j].low == half_edges[i].low && half_edges[j].high == half_edges[i].high)
      ++j;
    visit(&half_edges[i], &half_edges[i] + (j - i));
    i = j;
  }
}

}  // namespace dismantle
