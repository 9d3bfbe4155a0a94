// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/vertex_tree.h"

#include "dismantle/geometry/aabb.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <numeric>

namespace dismantle {

namespace {

/// Subtrees of at most so many vertices are built by one task.
constexpr std::uint32_t kTaskVertices = 4096;
/// Bounds the rounding of the length of a difference, relative to it and to the coordinates.
constexpr double kLengthRounding = 1e-15;

class Builder {
 public:
  Builder(VertexTree& tree, Span<const Vec3> vertices) : tree_(tree), vertices_(vertices) {}

  /// Fits the node's sphere and partitions its vertices between its halves. @pre !node.leaf()
  void split(const VertexNode& node) const {
    const auto begin = tree_.order.begin() + node.begin, end = tree_.order.begin() + node.end;
    Aabb box;
    for (auto v = begin; v != end; ++v) box.extend(vertices_[*v]);
    const Vec3 size = box.size();
    VertexTree::Sphere sphere;
    sphere.center = to_float(box.center() - tree_.origin);
    const Vec3 center = tree_.origin + to_double(sphere.center);
    double radius = 0;
    for (auto v = begin; v != end; ++v) radius = std::max(radius, length(vertices_[*v] - center));
    radius += kLengthRounding * (4 * radius + max_abs(center) + max_abs(tree_.origin));
    sphere.radius = rounded_up(radius);
    tree_.spheres[node.index] = sphere;

    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    std::nth_element(begin, begin + node.count() / 2, end, [&](std::uint32_t a, std::uint32_t b) {
      return vertices_[a][axis] != vertices_[b][axis] ? vertices_[a][axis] < vertices_[b][axis] : a < b;
    });
  }

  void build(const VertexNode& node) const {
    if (node.leaf()) return;
    split(node);
    build(node.left());
    build(node.right());
  }

 private:
  VertexTree& tree_;
  Span<const Vec3> vertices_;
};

}  // namespace

VertexSphere VertexTree::sphere(const VertexNode& node, Span<const Vec3> vertices) const {
  if (node.leaf()) return {vertices[order[node.begin]], 0};
  const Sphere& s = spheres[node.index];
  return {origin + to_double(s.center), s.radius};
}

VertexTree vertex_tree_build(Span<const Vec3> vertices, const Executor& executor) {
  VertexTree tree;
  if (vertices.empty()) return tree;
  tree.order.resize(vertices.size());
  std::iota(tree.order.begin(), tree.order.end(), 0u);
  tree.spheres.resize(vertices.size() - 1);
  Aabb box;
  for (const Vec3& v : vertices) box.extend(v);
  tree.origin = box.center();

  const Builder builder(tree, vertices);
  std::vector<VertexNode> level{tree.root()};
  while (!level.empty() && level.front().count() > kTaskVertices) {
    executor.for_each_heavy(level.size(), [&](std::size_t i) { builder.split(level[i]); });
    std::vector<VertexNode> next;
    for (const VertexNode& node : level) next.insert(next.end(), {node.left(), node.right()});
    level = std::move(next);
  }
  executor.for_each_heavy(level.size(), [&](std::size_t i) { builder.build(level[i]); });
  return tree;
}

}  // namespace dismantle
