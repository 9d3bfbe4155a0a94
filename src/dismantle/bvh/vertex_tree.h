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
  Vec3 center;        ///< [mm, the mesh's frame]; the vertex itself if there is one only.
  double radius = 0;  ///< [mm]; 0 for a single vertex.
};

/// A node of a VertexTree: the vertices order[begin, end), at least one.
struct VertexNode {
  std::uint32_t index = 0;  ///< Among the inner nodes, in pre-order; meaningless for a leaf.
  std::uint32_t begin = 0;  ///< First position in the tree's order.
  std::uint32_t end = 0;    ///< One past the last position in the tree's order.
  std::uint64_t path = 1;   ///< 1 for the root; a left half has twice its parent's, a right half one more.

  /// The number of vertices.
  std::uint32_t count() const { return end - begin; }
  /// True if it has one vertex.
  bool leaf() const { return count() == 1; }
  /// The first half. @pre !leaf()
  VertexNode left() const { return {index + 1, begin, begin + count() / 2, 2 * path}; }
  /// The second half. @pre !leaf()
  VertexNode right() const { return {index + count() / 2, begin + count() / 2, end, 2 * path + 1}; }
  /// True if this node and `right` are the left and the right half of one node.
  bool left_of(const VertexNode& right) const { return path % 2 == 0 && right.path == path + 1; }
  /// The node that both are the halves of. @pre left_of(right)
  VertexNode joined(const VertexNode& right) const { return {index - 1, begin, right.end, path / 2}; }
  friend bool operator==(const VertexNode&, const VertexNode&) = default;
};

/// A balanced tree of spheres over a component's vertices, one vertex a leaf: a test that a sphere passes need not be
/// made for its vertices. Only spheres are stored; a node is given by the range of vertices that it covers.
struct VertexTree {
  /// The sphere of an inner node.
  struct Sphere {
    Vec3f center;      ///< Relative to `origin` [mm].
    float radius = 0;  ///< [mm]
  };

  Vec3 origin;                       ///< That spheres are relative to [mm, the mesh's frame].
  std::vector<std::uint32_t> order;  ///< Vertex indices.
  std::vector<Sphere> spheres;       ///< Of the inner nodes, in pre-order.

  /// True if there are no vertices.
  bool empty() const { return order.empty(); }
  /// The node of all vertices. @pre !empty()
  VertexNode root() const { return {0, 0, static_cast<std::uint32_t>(order.size())}; }
  /// A sphere that certainly contains the node's vertices. @param vertices that the tree was built over
  VertexSphere sphere(const VertexNode& node, Span<const Vec3> vertices) const;
};

/// Builds the tree: every node is cut at the median of the longest side of its box. Every executor builds the same one.
VertexTree vertex_tree_build(Span<const Vec3> vertices, const Executor& executor);

}  // namespace dismantle
