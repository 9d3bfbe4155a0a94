// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/surface_tree.h"

#include "dismantle/bvh/bvh_build.h"
#include "dismantle/narrowphase/closest_points.h"

#include <algorithm>
#include <array>

namespace dismantle {

namespace {

/// Bound of the rounding of a squared distance, relative.
constexpr double kRounding = 1e-12;

/// Squared distance from a point to a box.
double distance_squared(const Aabb& box, Vec3 p) {
  const Vec3 outside = max(max(box.lower - p, p - box.upper), Vec3{});
  return dot(outside, outside);
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleMesh& mesh, const Executor& executor) {
  static_assert(kStackSize >= kBvhHeuristicDepth + 34);
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

MeshDistance SurfaceTree::distance(Vec3 point, std::uint32_t hint, double within) const {
  struct Waiting {
    NodeIndex node;
    double squared;
  };
  std::array<Waiting, kStackSize> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {bvh_.root(), 0};
  std::uint32_t best_face = hint;
  double best_squared = length_squared(point - closest_point_of_triangle(triangles_[hint], point));
  const double limit = within * within * (1 + kRounding);
  while (waiting > 0) {
    const Waiting at = stack[--waiting];
    if (at.squared >= best_squared || at.squared > limit) continue;
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
    stack[waiting++] = left;  // the nearer one is visited first
  }
  return {std::sqrt(best_squared), best_face};
}

}  // namespace dismantle
