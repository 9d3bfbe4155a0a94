// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/surface_tree.h"

#include "dismantle/bvh/bvh_build.h"

#include <algorithm>
#include <array>

namespace dismantle {

namespace {

Vec3 closest_point_of_segment(Vec3 a, Vec3 b, Vec3 p) {
  const Vec3 ab = b - a;
  const double along = dot(p - a, ab), whole = dot(ab, ab);
  if (!(along > 0)) return a;
  return along >= whole ? b : a + (along / whole) * ab;
}

// A way down leaves one sibling a level waiting; trees are no deeper than kBvhHeuristicDepth + log2 of the triangles.
constexpr std::size_t kStackSize = kBvhHeuristicDepth + 34;

double distance_squared(const Aabb& box, Vec3 p) {
  const Vec3 outside = max(max(box.lower - p, p - box.upper), Vec3{});
  return dot(outside, outside);
}

}  // namespace

Vec3 closest_point_of_triangle(const Triangle& t, Vec3 p) {
  Vec3 best = closest_point_of_segment(t[0], t[1], p);
  double best_squared = length_squared(p - best);
  const auto consider = [&](Vec3 q) {
    const double squared = length_squared(p - q);
    if (squared >= best_squared) return;
    best_squared = squared;
    best = q;
  };
  consider(closest_point_of_segment(t[1], t[2], p));
  consider(closest_point_of_segment(t[2], t[0], p));

  const Vec3 n = normal_unscaled(t);
  const double weight[3] = {dot(n, cross(t[2] - t[1], p - t[1])), dot(n, cross(t[0] - t[2], p - t[2])),
                            dot(n, cross(t[1] - t[0], p - t[0]))};
  const double sum = weight[0] + weight[1] + weight[2];
  if (weight[0] > 0 && weight[1] > 0 && weight[2] > 0)
    consider(t[0] + (weight[1] / sum) * (t[1] - t[0]) + (weight[2] / sum) * (t[2] - t[0]));
  return best;
}

SurfaceTree::SurfaceTree(const TriangleMesh& mesh, const Executor& executor) {
  DISMANTLE_EXPECT(!mesh.faces.empty());
  std::vector<Aabb> triangle_boxes;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    triangles_.push_back(mesh.triangle(f));
    Aabb box;
    for (const Vec3& corner : triangles_.back().corner) box.extend(corner);
    triangle_boxes.push_back(box);
  }
  const std::vector<std::uint32_t> component_begin{0, static_cast<std::uint32_t>(mesh.faces.size())};
  bvh_ = bvh_build({triangle_boxes, component_begin}, executor);

  boxes_.resize(bvh_.node_count());
  for (NodeIndex node = 0; node < bvh_.leaf_count(); ++node) boxes_[node] = triangle_boxes[bvh_.leaf_triangle[node]];
  for (NodeIndex node = bvh_.leaf_count(); node < bvh_.node_count(); ++node) {
    const BvhChildren children = bvh_.children[node - bvh_.leaf_count()];
    boxes_[node].extend(boxes_[children.left]);
    boxes_[node].extend(boxes_[children.right]);
  }
}

double SurfaceTree::distance_to_face(Vec3 point, std::uint32_t face) const {
  return length(point - closest_point_of_triangle(triangles_[face], point));
}

MeshDistance SurfaceTree::distance(Vec3 point, std::uint32_t hint) const {
  struct Waiting {
    NodeIndex node;
    double squared;
  };
  std::array<Waiting, kStackSize> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {bvh_.root(), 0};
  std::uint32_t best_face = hint;
  double best_squared = length_squared(point - closest_point_of_triangle(triangles_[hint], point));
  while (waiting > 0) {
    const Waiting at = stack[--waiting];
    if (at.squared >= best_squared) continue;
    if (at.node < bvh_.leaf_count()) {
      const std::uint32_t face = bvh_.leaf_triangle[at.node];
      const double squared = length_squared(point - closest_point_of_triangle(triangles_[face], point));
      if (squared >= best_squared) continue;
      best_squared = squared;
      best_face = face;
      continue;
    }
    const BvhChildren children = bvh_.children[at.node - bvh_.leaf_count()];
    Waiting left{children.left, distance_squared(boxes_[children.left], point)};
    Waiting right{children.right, distance_squared(boxes_[children.right], point)};
    if (left.squared > right.squared) std::swap(left, right);
    DISMANTLE_EXPECT(waiting + 2 <= stack.size());
    stack[waiting++] = right;
    stack[waiting++] = left;  // the nearer one is looked at first
  }
  return {std::sqrt(best_squared), best_face};
}

}  // namespace dismantle
