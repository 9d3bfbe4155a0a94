// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/exec/executor.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// A sphere around some vertices.
struct VertexSphere {
  Vec3 center;        ///< [mm, the mesh's frame]
  double radius = 0;  ///< [mm]; 0 for a single vertex, whose place the center is.
};

/// A node of a VertexTree: the vertices order[begin, end), at least one.
struct VertexNode {
  std::uint32_t place = 0;  ///< Among the inner nodes, in pre-order; says nothing for a leaf.
  std::uint32_t begin = 0, end = 0;
  std::uint64_t path = 1;  ///< 1 for the root; a left half has twice its parent's, a right half one more.

  std::uint32_t count() const { return end - begin; }
  bool leaf() const { return count() == 1; }
  /// The halves. @pre !leaf()
  VertexNode left() const { return {place + 1, begin, begin + count() / 2, 2 * path}; }
  VertexNode right() const { return {place + count() / 2, begin + count() / 2, end, 2 * path + 1}; }
  /// True where `right` is the other half of what this node is the left half of.
  bool left_of(const VertexNode& right) const { return path % 2 == 0 && right.path == path + 1; }
  /// What both are halves of. @pre left_of(right)
  VertexNode joined(const VertexNode& right) const { return {place - 1, begin, right.end, path / 2}; }
  friend bool operator==(const VertexNode&, const VertexNode&) = default;
};

/// A balanced tree of spheres over a component's vertices, so that what holds for a sphere need not be asked of each
/// of them. One vertex a leaf. Only spheres are stored: a node is known by the range of vertices that it covers.
struct VertexTree {
  /// Of an inner node, about `origin`.
  struct Sphere {
    Vec3f center;
    float radius = 0;
  };

  Vec3 origin;
  std::vector<std::uint32_t> order;  ///< Vertex indices.
  std::vector<Sphere> spheres;       ///< Of the inner nodes, in pre-order.

  bool empty() const { return order.empty(); }
  /// @pre !empty()
  VertexNode root() const { return {0, 0, static_cast<std::uint32_t>(order.size())}; }
  /// Certainly contains the node's vertices. @param vertices those that the tree was built over
  VertexSphere sphere(const VertexNode& node, Span<const Vec3> vertices) const;
};

/// Builds the tree: every node is cut in the middle of its longest side. The same tree for every executor.
VertexTree vertex_tree_build(Span<const Vec3> vertices, const Executor& executor);

}  // namespace dismantle
