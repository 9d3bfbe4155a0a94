// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/core/span.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Index of a node of a Bvh. Leaves come first: node i < leaf_count() is the leaf of the i-th triangle in leaf order.
using NodeIndex = std::uint32_t;
inline constexpr NodeIndex kNoNode = 0xffffffffu;

/// The two children of an inner node.
struct BvhChildren {
  NodeIndex left = kNoNode, right = kNoNode;
  friend bool operator==(const BvhChildren&, const BvhChildren&) = default;
};

/// What lies below one component's root, as ranges: leaves [leaf_begin, leaf_end) and inner nodes [inner_begin,
/// inner_end), in post-order (children before parents, the root last).
struct BvhComponent {
  NodeIndex leaf_begin = 0, leaf_end = 0;
  NodeIndex inner_begin = 0, inner_end = 0;
  NodeIndex root = kNoNode;  ///< kNoNode for a component without triangles.
  std::uint32_t leaf_count() const { return leaf_end - leaf_begin; }
  friend bool operator==(const BvhComponent&, const BvhComponent&) = default;
};

/// A binary bounding volume hierarchy over the triangles of all components, without its bounds: topology only, built
/// once. One triangle a leaf. Every node lies below one component's root or has whole components below it ("top"
/// nodes).
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

  NodeIndex leaf_count() const { return static_cast<NodeIndex>(leaf_triangle.size()); }
  NodeIndex node_count() const { return static_cast<NodeIndex>(leaf_triangle.size() + children.size()); }
  bool empty() const { return leaf_triangle.empty(); }
  /// @pre !empty()
  NodeIndex root() const { return node_count() - 1; }
  friend bool operator==(const Bvh&, const Bvh&) = default;
};

/// The topology as kernels see it.
struct BvhView {
  Span<const BvhChildren> children;
  Span<const std::uint32_t> component_of;
  NodeIndex leaf_count = 0;
  NodeIndex top_begin = 0;

  BvhView() = default;
  explicit BvhView(const Bvh& bvh)
      : children(bvh.children),
        component_of(bvh.component_of),
        leaf_count(bvh.leaf_count()),
        top_begin(bvh.top_begin) {}

  DISMANTLE_HOST_DEVICE bool is_leaf(NodeIndex node) const { return node < leaf_count; }
  DISMANTLE_HOST_DEVICE bool is_top(NodeIndex node) const { return node >= top_begin; }
  /// @pre !is_leaf(node)
  DISMANTLE_HOST_DEVICE BvhChildren children_of(NodeIndex node) const { return children[node - leaf_count]; }
};

}  // namespace dismantle
