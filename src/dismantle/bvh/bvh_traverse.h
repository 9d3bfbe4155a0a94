// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/geometry/kdop.h"

#include <cstdint>
#include <utility>

namespace dismantle {

/// A node pair of the bounding volume traversal tree (BVTT).
struct NodePair {
  NodeIndex a = kNoNode;  ///< One node.
  NodeIndex b = kNoNode;  ///< The other node, or the same.
  friend bool operator==(const NodePair&, const NodePair&) = default;
};

/// A pair of nodes or leaves as one 64-bit key, the lower index first: sorted keys are in order of (a, b).
DISMANTLE_HOST_DEVICE inline std::uint64_t pair_key(NodeIndex a, NodeIndex b) {
  const std::uint64_t low = a < b ? a : b, high = a < b ? b : a;
  return low << 32 | high;
}

/// The pair of a key: a <= b.
DISMANTLE_HOST_DEVICE inline NodePair pair_of_key(std::uint64_t key) {
  return {static_cast<NodeIndex>(key >> 32), static_cast<NodeIndex>(key & 0xffffffffu)};
}

/// The children of a node pair in the BVTT.
struct NodePairChildren {
  NodePair pair[3];  ///< The first `count` are set.
  int count = 0;     ///< 2, or 3 for a node paired with itself.
};

/// Expands a pair that is not two leaves. A node with itself: each child with itself, and both together. Otherwise one
/// node is replaced by its children: a top node before one below, else the larger.
/// @pre !(is_leaf(a) && is_leaf(b))
DISMANTLE_HOST_DEVICE inline NodePairChildren expanded(const BvhView& tree, Span<const Kdop16> bounds, NodePair p) {
  if (p.a == p.b) {
    const BvhChildren c = tree.children_of(p.a);
    return {{{c.left, c.left}, {c.right, c.right}, {c.left, c.right}}, 3};
  }
  bool take_a = !tree.is_leaf(p.a);
  if (take_a && !tree.is_leaf(p.b)) {
    const bool top_a = tree.is_top(p.a), top_b = tree.is_top(p.b);
    const float extent_a = extent(bounds[p.a]), extent_b = extent(bounds[p.b]);
    take_a = top_a != top_b ? top_a : (extent_a != extent_b ? extent_a > extent_b : p.a > p.b);
  }
  if (take_a) {
    const BvhChildren c = tree.children_of(p.a);
    return {{{c.left, p.b}, {c.right, p.b}, {}}, 2};
  }
  const BvhChildren c = tree.children_of(p.b);
  return {{{p.a, c.left}, {p.a, c.right}, {}}, 2};
}

/// Calls visit(leaf_a, leaf_b) once for every pair of leaves below `start` whose bounds overlap and that belong to
/// different components, depth first. leaf_a < leaf_b, so a's component comes first.
template <class Visit>
void bvh_traverse(const BvhView& tree, Span<const Kdop16> bounds, NodePair start, Visit&& visit) {
  std::vector<NodePair> open{start};
  while (!open.empty()) {
    const NodePair p = open.back();
    open.pop_back();
    if (!tree.is_top(p.a) && !tree.is_top(p.b) && tree.component_of[p.a] == tree.component_of[p.b]) continue;
    if (!overlaps(bounds[p.a], bounds[p.b])) continue;
    if (tree.is_leaf(p.a) && tree.is_leaf(p.b)) {
      p.a < p.b ? visit(p.a, p.b) : visit(p.b, p.a);
      continue;
    }
    const NodePairChildren next = expanded(tree, bounds, p);
    for (int k = 0; k < next.count; ++k) open.push_back(next.pair[k]);
  }
}

/// Calls visit(a, b), a < b, for every pair of components whose bounds overlap.
template <class Visit>
void bvh_traverse_components(const Bvh& bvh, Span<const Kdop16> bounds, Visit&& visit) {
  if (bvh.empty()) return;
  const BvhView tree(bvh);
  std::vector<NodePair> open{{bvh.root(), bvh.root()}};
  while (!open.empty()) {
    const NodePair p = open.back();
    open.pop_back();
    const bool top = tree.is_top(p.a) || tree.is_top(p.b);
    if ((!top && p.a == p.b) || !overlaps(bounds[p.a], bounds[p.b])) continue;
    if (!top) {
      const std::uint32_t a = tree.component_of[p.a], b = tree.component_of[p.b];
      visit(ComponentId(a < b ? a : b), ComponentId(a < b ? b : a));
      continue;
    }
    const NodePairChildren next = expanded(tree, bounds, p);
    for (int k = 0; k < next.count; ++k) open.push_back(next.pair[k]);
  }
}

}  // namespace dismantle
