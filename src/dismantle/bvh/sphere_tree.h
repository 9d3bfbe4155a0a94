// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/math/vec3.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace dismantle {

/// A sphere around something.
struct BoundingSphere {
  Vec3 center;        ///< [mm]
  double radius = 0;  ///< [mm]
};

/// A balanced tree over spheres, for queries that concern few of them.
class SphereTree {
 public:
  /// Over nothing.
  SphereTree() = default;
  /// Builds the tree. A sphere is known by its index.
  explicit SphereTree(Span<const BoundingSphere> spheres);

  /// Calls visit(index) for every sphere but those whose nodes a bound excludes, the nearer of two nodes first.
  /// @param bound (sphere) -> a number that is no larger for a sphere than for any sphere inside it
  /// @param limit () -> what is excluded now: nodes with larger bounds; `visit` may lower it
  template <class Bound, class Limit, class Visit>
  void traverse(const Bound& bound, const Limit& limit, const Visit& visit) const;

 private:
  /// The spheres order_[begin, end).
  struct Node {
    BoundingSphere sphere;          ///< Contains them, with a margin for rounding.
    std::uint32_t begin, end;       ///< Range in the order.
    std::uint32_t left = 0, right;  ///< Its halves; left is 0 for a leaf.
  };
  std::uint32_t add_node(Span<const BoundingSphere> spheres, std::uint32_t begin, std::uint32_t end);

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;  ///< The root first.
};

template <class Bound, class Limit, class Visit>
void SphereTree::traverse(const Bound& bound, const Limit& limit, const Visit& visit) const {
  if (nodes_.empty()) return;
  std::vector<std::pair<double, std::uint32_t>> open{{bound(nodes_[0].sphere), 0}};
  while (!open.empty()) {
    const auto [nearest, index] = open.back();
    open.pop_back();
    if (nearest > limit()) continue;
    const Node& node = nodes_[index];
    if (node.left == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) visit(order_[i]);
      continue;
    }
    std::pair near(bound(nodes_[node.left].sphere), node.left), far(bound(nodes_[node.right].sphere), node.right);
    if (far.first < near.first) std::swap(near, far);
    open.push_back(far);
    open.push_back(near);
  }
}

}  // namespace dismantle
