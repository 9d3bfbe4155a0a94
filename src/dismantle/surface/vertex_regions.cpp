// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/vertex_regions.h"

#include <algorithm>
#include <numeric>

namespace dismantle {

VertexRegions::VertexRegions(const AssemblyTriangles& triangles, ComponentId component, Span<const NodeIndex> cut)
    : begin_(triangles.vertex_begin[component.value]), parent_(triangles.vertex_begin[component.value + 1] - begin_) {
  std::iota(parent_.begin(), parent_.end(), 0u);
  const BvhComponent& range = triangles.bvh.components[component.value];
  for (NodeIndex leaf = range.leaf_begin; leaf < range.leaf_end; ++leaf) {
    if (std::binary_search(cut.begin(), cut.end(), leaf)) continue;
    const Face& f = triangles.faces[leaf];
    join(f.v[0], f.v[1]);
    join(f.v[0], f.v[2]);
  }
}

std::uint32_t VertexRegions::region_of(std::uint32_t vertex) {
  std::uint32_t v = vertex - begin_;
  while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
  return v + begin_;
}

std::vector<std::uint32_t> shell_vertices(const AssemblyTriangles& triangles, ComponentId component) {
  VertexRegions regions(triangles, component);
  std::vector<std::uint32_t> shells;
  const std::uint32_t end = triangles.vertex_begin[component.value + 1];
  for (std::uint32_t v = triangles.vertex_begin[component.value]; v < end; ++v)
    if (regions.region_of(v) == v) shells.push_back(v);
  return shells;
}

}  // namespace dismantle
