// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/half_edges.h"

#include <algorithm>
#include <tuple>

namespace dismantle {

std::vector<HalfEdge> sorted_half_edges(Span<const Face> faces) {
  std::uint32_t vertices = 0;
  for (const Face& face : faces)
    for (const std::uint32_t v : face.v) vertices = std::max(vertices, v + 1);
  const auto visit = [&](const auto& take) {
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      for (std::uint8_t k = 0; k < 3; ++k) {
        const std::uint32_t a = faces[f].v[k], b = faces[f].v[(k + 1) % 3];
        take(HalfEdge{std::min(a, b), std::max(a, b), f, k, a < b});
      }
    }
  };
  // A counting sort by the lower vertex: few half edges have the same.
  std::vector<std::size_t> begin(vertices + std::size_t{1}, 0);
  visit([&](const HalfEdge& edge) { ++begin[edge.low + std::size_t{1}]; });
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  std::vector<HalfEdge> half_edges(3 * faces.size());
  std::vector<std::size_t> next = begin;
  visit([&](const HalfEdge& edge) { half_edges[next[edge.low]++] = edge; });
  for (std::size_t v = 0; v < vertices; ++v)
    std::sort(half_edges.begin() + static_cast<std::ptrdiff_t>(begin[v]),
              half_edges.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]), [](const HalfEdge& a, const HalfEdge& b) {
                return std::tie(a.high, a.face, a.side) < std::tie(b.high, b.face, b.side);
              });
  return half_edges;
}

}  // namespace dismantle
