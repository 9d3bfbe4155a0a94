// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  void join(std::uint32_t a, std::uint32_t b) { parent_[region_of(b) - begin_] = region_of(a) - begin_; }

  std::uint32_t begin_;
  std::vector<std::uint32_t> parent_;
};

/// One vertex of each connected part of the component's surface. Where surfaces do not intersect, it tells for its
/// whole part on which side of another surface it is. @return indices into AssemblyTriangles::vertices, ascending
std::vector<std::uint32_t> shell_vertices(const AssemblyTriangles& triangles, ComponentId component);

}  // namespace dismantle
