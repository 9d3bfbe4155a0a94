// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/connected_sets.h"
#include "dismantle/core/span.h"
#include "dismantle/surface/assembly_triangles.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The vertices of one component in regions that are connected by triangles (a union-find).
class VertexRegions {
 public:
  /// @param cut leaves of the component whose triangles connect nothing; sorted
  VertexRegions(const AssemblyTriangles& triangles, ComponentId component, Span<const NodeIndex> cut = {});

  /// The vertex that represents the region of `vertex`; both are indices into AssemblyTriangles::vertices.
  /// @pre `vertex` is one of the component
  std::uint32_t region_of(std::uint32_t vertex);

 private:
  std::uint32_t begin_;
  ConnectedSets sets_;  // of vertices, from begin_ on
};

/// One vertex of each connected part of the component's surface. Where surfaces do not intersect, it tells for its
/// whole part on which side of another surface it is. @return indices into AssemblyTriangles::vertices, ascending
std::vector<std::uint32_t> shell_vertices(const AssemblyTriangles& triangles, ComponentId component);

}  // namespace dismantle
