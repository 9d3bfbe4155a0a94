// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/half_edges.h"

#include <algorithm>

namespace dismantle {

std::vector<HalfEdge> sorted_half_edges(Span<const Face> faces) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t a = faces[f].v[k], b = faces[f].v[(k + 1) % 3];
      half_edges.push_back({std::min(a, b), std::max(a, b), f, k, a < b});
    }
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.face < b.face;
  });
  return half_edges;
}

}  // namespace dismantle
