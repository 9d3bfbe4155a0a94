// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/wide_bvh.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace dismantle {

namespace {

/// A node of the binary BVH that becomes a node with more children.
struct Merged {
  NodeIndex node;
  std::uint32_t index;  // of the node that it becomes
};

double surface_of(const Aabb& box) {
  const Vec3 size = box.size();
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

}  // namespace

WideBvh::WideBvh(const Bvh& bvh, Span<const Aabb> boxes) {
  DISMANTLE_EXPECT(!bvh.empty() && bvh.leaf_count() < kLeaf);
  const Aabb& all = boxes[bvh.root()];
  origin_ = all.center();
  size_ = norm_one(all.upper - origin_);
  const auto set = [&](Node& node, std::size_t k, NodeIndex child) {
    const Vec3 lower = boxes[child].lower - origin_, upper = boxes[child].upper - origin_;
    for (int i = 0; i < 3; ++i) {
      node.lower[i][k] = -rounded_up(-lower[i]);
      node.upper[i][k] = rounded_up(upper[i]);
    }
  };
  Node empty;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < kWidth; ++k) {
      empty.lower[i][k] = std::numeric_limits<float>::infinity();
      empty.upper[i][k] = -std::numeric_limits<float>::infinity();
    }
  std::fill(std::begin(empty.child), std::end(empty.child), 0);

  nodes_.push_back(empty);
  std::vector<Merged> waiting{{bvh.root(), 0}};
  while (!waiting.empty()) {
    const Merged merged = waiting.back();
    waiting.pop_back();
    // The largest inner node is replaced by its children until there are enough.
    std::array<NodeIndex, kWidth> children{merged.node};
    std::size_t count = 1;
    while (count < kWidth) {
      std::size_t largest = kWidth;
      for (std::size_t k = 0; k < count; ++k)
        if (children[k] >= bvh.leaf_count() &&
            (largest == kWidth || surface_of(boxes[children[k]]) > surface_of(boxes[children[largest]])))
          largest = k;
      if (largest == kWidth) break;
      const BvhChildren both = bvh.children[children[largest] - bvh.leaf_count()];
      children[largest] = both.left;
      children[count++] = both.right;
    }
    for (std::size_t k = 0; k < count; ++k) {
      std::uint32_t child = 0;
      if (children[k] < bvh.leaf_count()) {
        child = kLeaf | bvh.leaf_triangle[children[k]];
      } else {
        child = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back(empty);
        waiting.push_back({children[k], child});
      }
      set(nodes_[merged.index], k, children[k]);
      nodes_[merged.index].child[k] = child;
    }
  }
}

}  // namespace dismantle
