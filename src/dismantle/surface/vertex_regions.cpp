// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/vertex_regions.h"

#include <algorithm>

namespace dismantle {

VertexRegions::VertexRegions(const AssemblyTriangles& triangles, ComponentId component, Span<const NodeIndex> cut)
    : begin_(triangles.vertex_begin[component.value]), sets_(triangles.vertex_begin[component.value + 1] - begin_) {
  const BvhComponent& range = triangles.bvh.components[component.value];
  for (NodeIndex leaf = range.leaf_begin; leaf < range.leaf_end; ++leaf) {
    if (std::binary_search(cut.begin(), cut.end(), leaf)) continue;
    const Face& f = triangles.faces[leaf];
    for (const int k : {1, 2}) sets_.join(f.v[0] - begin_, f.v[k] - begin_);
  }
}

std::uint32_t VertexRegions::region_of(std::uint32_t vertex) {
  return sets_.set_of(vertex - begin_) + begin_;
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
