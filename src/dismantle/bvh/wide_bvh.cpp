// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/wide_bvh.h"

#include "dismantle/core/contract.h"
#include "dismantle/math/lanes.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

namespace dismantle {

namespace {

/// Rounding of a squared distance in single precision: three squares of differences, and their sum.
constexpr float kSquareRounding = 0x1p-20f;
/// Rounding of a difference of coordinates, relative to their sizes: 2^-24 each for the point, the difference, and what
/// is made of it.
constexpr double kPositionRounding = 0x1p-21;
/// A smaller component of a direction moves the ray by far less than the margin within the boxes.
constexpr float kAcross = 1e-12f;

using Four = Lanes<WideBvh::kWidth>;

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

float WideBvh::margin(Vec3 point) const {
  return rounded_up(kPositionRounding * (size_ + norm_one(point - origin_)));
}

WideBvh::Distances::Distances(const WideBvh& bvh, Vec3 point) : margin_(bvh.margin(point)) {
  const Vec3 from = point - bvh.origin_;
  for (int i = 0; i < 3; ++i) point_[i] = static_cast<float>(from[i]);
}

unsigned WideBvh::Distances::within(const Node& node, float limit, float (&squared)[kWidth]) const {
  Four sum(0);
  for (int i = 0; i < 3; ++i) {
    const Four below = Four::load(node.lower[i]) - point_[i], above = point_[i] - Four::load(node.upper[i]);
    const Four outside = max(max(below, above) - margin_, Four(0));
    sum = sum + outside * outside;
  }
  sum = sum * Four(1 - kSquareRounding);
  sum.store(squared);
  return bits(sum <= Four(limit));
}

WideBvh::Ray::Ray(const WideBvh& bvh, Vec3 point, Vec3 direction) : margin_(bvh.margin(point)) {
  const Vec3 from = point - bvh.origin_;
  const double size = max_abs(direction);
  for (int i = 0; i < 3; ++i) {
    point_[i] = static_cast<float>(from[i]);
    const auto along = static_cast<float>(direction[i] / size);
    is_across_[i] = std::abs(along) < kAcross;
    per_length_[i] = is_across_[i] ? 0 : 1 / along;
  }
}

unsigned WideBvh::Ray::met(const Node& node) const {
  Four enter(0), leave(std::numeric_limits<float>::max());
  LaneMask<kWidth> may = enter <= leave;
  for (int i = 0; i < 3; ++i) {
    const Four lower = Four::load(node.lower[i]) - point_[i] - margin_;
    const Four upper = Four::load(node.upper[i]) - point_[i] + margin_;
    may = may & (lower <= upper);
    if (is_across_[i]) {
      may = may & (lower <= Four(0)) & (upper >= Four(0));
      continue;
    }
    const Four a = lower * per_length_[i], b = upper * per_length_[i];
    enter = max(enter, min(a, b));
    leave = min(leave, max(a, b));
  }
  return bits(may & (enter <= leave));
}

}  // namespace dismantle
