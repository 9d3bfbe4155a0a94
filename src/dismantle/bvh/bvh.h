// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/core/span.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Index of a node of a Bvh. Leaves come first: node i < leaf_count() is the leaf of the i-th triangle in leaf order.
using NodeIndex = std::uint32_t;
/// The index of no node.
inline constexpr NodeIndex kNoNode = 0xffffffffu;

/// The two children of an inner node; both have smaller indices than it.
struct BvhChildren {
  NodeIndex left = kNoNode;   ///< The first child.
  NodeIndex right = kNoNode;  ///< The second child.
  friend bool operator==(const BvhChildren&, const BvhChildren&) = default;
};

/// The nodes of one component's subtree, as ranges.
struct BvhComponent {
  NodeIndex leaf_begin = 0;   ///< First leaf.
  NodeIndex leaf_end = 0;     ///< One past the last leaf.
  NodeIndex inner_begin = 0;  ///< First inner node; they are in post-order (children before parents, the root last).
  NodeIndex inner_end = 0;    ///< One past the last inner node.
  NodeIndex root = kNoNode;   ///< kNoNode for a component without triangles.
  /// The number of leaves.
  std::uint32_t leaf_count() const { return leaf_end - leaf_begin; }
  friend bool operator==(const BvhComponent&, const BvhComponent&) = default;
};

/// The topology of a binary bounding volume hierarchy over the triangles of all components, one triangle a leaf. It is
/// built once; bounds are kept apart. Every node lies below one component's root or has whole components below it
/// ("top" nodes).
///
/// Node order, n = leaf_count(): leaves [0, n), component after component; then the inner nodes of component after
/// component, each in post-order, so that a subtree's nodes are one range; then the top nodes in post-order. The root
/// is the last node.
struct Bvh {
  std::vector<BvhChildren> children;         ///< Of inner node i at [i - leaf_count()].
  std::vector<std::uint32_t> leaf_triangle;  ///< The builder's input triangle of each leaf.
  std::vector<std::uint32_t> component_of;   ///< Of each node; ComponentId::kInvalid for top nodes.
  std::vector<BvhComponent> components;      ///< Shape [component_count].
  NodeIndex top_begin = 0;                   ///< The first top node; node_count() where there is none.

  /// The number of leaves, which is that of triangles.
  NodeIndex leaf_count() const { return static_cast<NodeIndex>(leaf_triangle.size()); }
  /// The number of all nodes.
  NodeIndex node_count() const { return static_cast<NodeIndex>(leaf_triangle.size() + children.size()); }
  /// True if there are no triangles.
  bool empty() const { return leaf_triangle.empty(); }
  /// The root of all components. @pre !empty()
  NodeIndex root() const { return node_count() - 1; }
  friend bool operator==(const Bvh&, const Bvh&) = default;
};

/// A view of the topology for kernels.
struct BvhView {
  Span<const BvhChildren> children;        ///< As Bvh::children.
  Span<const std::uint32_t> component_of;  ///< As Bvh::component_of.
  NodeIndex leaf_count = 0;                ///< As Bvh::leaf_count().
  NodeIndex top_begin = 0;                 ///< As Bvh::top_begin.

  BvhView() = default;
  /// Views the tree, which must outlive it.
  explicit BvhView(const Bvh& bvh)
      : children(bvh.children),
        component_of(bvh.component_of),
        leaf_count(bvh.leaf_count()),
        top_begin(bvh.top_begin) {}

  /// True for a leaf.
  DISMANTLE_HOST_DEVICE bool is_leaf(NodeIndex node) const { return node < leaf_count; }
  /// True for a node that has whole components below it.
  DISMANTLE_HOST_DEVICE bool is_top(NodeIndex node) const { return node >= top_begin; }
  /// The children of an inner node. @pre !is_leaf(node)
  DISMANTLE_HOST_DEVICE BvhChildren children_of(NodeIndex node) const { return children[node - leaf_count]; }
};

}  // namespace dismantle
