// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/sphere_tree.h"

#include "dismantle/geometry/aabb.h"

#include <algorithm>
#include <numeric>

namespace dismantle {

namespace {

constexpr std::uint32_t kLeafSize = 4;
/// Bounds the rounding of a node's radius, relative to it and to the coordinates.
constexpr double kRounding = 1e-14;

}  // namespace

SphereTree::SphereTree(Span<const BoundingSphere> spheres) : order_(spheres.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!spheres.empty()) add_node(spheres, 0, static_cast<std::uint32_t>(spheres.size()));
}

std::uint32_t SphereTree::add_node(Span<const BoundingSphere> spheres, std::uint32_t begin, std::uint32_t end) {
  const auto first = order_.begin() + begin, last = order_.begin() + end;
  Aabb box, centers;
  for (auto i = first; i != last; ++i) {
    const auto& [center, radius] = spheres[*i];
    box.extend(center - Vec3{radius, radius, radius});
    box.extend(center + Vec3{radius, radius, radius});
    centers.extend(center);
  }
  Node node{{box.center(), 0}, begin, end, 0, 0};
  double& radius = node.sphere.radius;
  for (auto i = first; i != last; ++i)
    radius = std::max(radius, length(spheres[*i].center - node.sphere.center) + spheres[*i].radius);
  radius += kRounding * (radius + max_abs(node.sphere.center));
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return index;

  const Vec3 size = centers.size();
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(first, order_.begin() + middle, last, [&](std::uint32_t a, std::uint32_t b) {
    const double at_a = spheres[a].center[axis], at_b = spheres[b].center[axis];
    return at_a != at_b ? at_a < at_b : a < b;
  });
  const std::uint32_t left = add_node(spheres, begin, middle), right = add_node(spheres, middle, end);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

}  // namespace dismantle
