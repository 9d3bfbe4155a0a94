// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/adjacency.h"

#include <algorithm>

namespace dismantle {

namespace {

struct HalfEdge {
  std::uint32_t low, high;  // the two vertices, sorted
  std::uint32_t face;
  std::uint8_t side;  // from corner `side` to the next one
  bool forward;       // runs from low to high
};

std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.faces[f].v[k], b = mesh.faces[f].v[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), f, k, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.face < b.face;
  });
  return edges;
}

/// Calls visit(first, last) for each run of half edges that are the same edge.
template <class Visit>
void for_each_edge(const std::vector<HalfEdge>& edges, Visit visit) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    visit(&edges[i], &edges[i] + (j - i));
    i = j;
  }
}

}  // namespace

EdgeFaults edge_faults(const TriangleMesh& mesh) {
  EdgeFaults faults;
  for_each_edge(sorted_half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    const auto count = last - first;
    if (count == 1) ++faults.boundary;
    if (count > 2) ++faults.nonmanifold;
    if (count == 2 && first[0].forward == first[1].forward) ++faults.misoriented;
  });
  return faults;
}

std::vector<std::uint8_t> representative_features(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> features(mesh.faces.size(), 0);
  std::vector<bool> vertex_taken(mesh.vertices.size(), false);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.faces[f].v[k];
      if (vertex_taken[v]) continue;
      vertex_taken[v] = true;
      features[f] |= static_cast<std::uint8_t>(1u << k);
    }
  }
  for_each_edge(sorted_half_edges(mesh), [&](const HalfEdge* first, const HalfEdge*) {
    features[first->face] |= static_cast<std::uint8_t>(8u << first->side);
  });
  return features;
}

}  // namespace dismantle
