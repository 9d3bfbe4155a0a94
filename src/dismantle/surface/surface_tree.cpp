// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/surface_tree.h"

#include "dismantle/bvh/bvh_build.h"
#include "dismantle/math/vec3f.h"
#include "dismantle/narrowphase/closest_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace dismantle {

namespace {

/// Bound of the rounding of a squared distance, relative.
constexpr double kRounding = 1e-12;
/// Bound of the rounding of a turned point, relative to its coordinates.
constexpr double kTurnRounding = 1e-15;
/// Faces are parallel where the cosine between their normals differs from 1 by less than this, and perpendicular where
/// it is less than the second value.
constexpr double kParallel = 1e-10, kPerpendicular = 1e-5;
/// Axes are sought among the normals of this number of faces, the largest ones.
constexpr std::size_t kLargestFaces = 16;
/// Boxes are turned where this share more of the surface is flat along the axes then.
constexpr double kWorthwhile = 0.1;

/// The normals of faces with area, and the areas.
struct FaceNormals {
  std::vector<Vec3> normal;
  std::vector<double> area;

  explicit FaceNormals(const std::vector<Triangle>& triangles) {
    for (const Triangle& t : triangles) {
      const Vec3 n = normal_unscaled(t);
      const double size = length(n);
      if (!(size > 0)) continue;
      normal.push_back(n / size);
      area.push_back(size / 2);
    }
  }

  /// The area of the faces that are perpendicular to one of some axes.
  double area_across(Span<const Vec3> axes) const {
    double sum = 0;
    for (std::size_t f = 0; f < normal.size(); ++f)
      if (std::any_of(axes.begin(), axes.end(),
                      [&](Vec3 axis) { return std::abs(dot(normal[f], axis)) > 1 - kParallel; }))
        sum += area[f];
    return sum;
  }
};

/// The axes along which most of a surface is flat, as rows of a rotation: those of its frame where they are about as
/// good as any.
Mat3 flat_axes(const std::vector<Triangle>& triangles) {
  const FaceNormals faces(triangles);
  std::vector<std::size_t> order(faces.normal.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t count = std::min(kLargestFaces, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
      [&](std::size_t f, std::size_t g) { return std::pair(-faces.area[f], f) < std::pair(-faces.area[g], g); });
  order.resize(count);
  // The normal across which most of the surface is; null for none.
  const auto best_of = [&](const auto& allowed) {
    Vec3 best;
    double most = 0;
    for (const std::size_t f : order) {
      const Vec3 n = faces.normal[f];
      if (!allowed(n)) continue;
      const double area = faces.area_across({&n, 1});
      if (area > most) {
        most = area;
        best = n;
      }
    }
    return best;
  };
  const Mat3 frame;
  const Vec3 first = best_of([](Vec3) { return true; });
  if (length_squared(first) == 0) return frame;
  Vec3 second = best_of([&](Vec3 n) { return std::abs(dot(n, first)) < kPerpendicular; });
  if (length_squared(second) == 0)
    second = *std::min_element(frame.row, frame.row + 3,
                               [&](Vec3 a, Vec3 b) { return std::abs(dot(a, first)) < std::abs(dot(b, first)); });
  const Vec3 third = normalized(cross(first, second));
  const Mat3 turned{{first, cross(third, first), third}};
  const double total = std::accumulate(faces.area.begin(), faces.area.end(), 0.0);
  const double gained = faces.area_across({turned.row, 3}) - faces.area_across({frame.row, 3});
  return gained > kWorthwhile * total ? turned : frame;
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleMesh& mesh, const Executor& executor) {
  static_assert(kStackSize >= kBvhHeuristicDepth + 34);
  DISMANTLE_EXPECT(!mesh.faces.empty());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) triangles_.push_back(mesh.triangle(f));
  axes_ = flat_axes(triangles_);
  const bool is_turned = !(axes_ == Mat3{});
  std::vector<Aabb> triangle_boxes;
  for (const Triangle& t : triangles_) {
    Aabb box, turned;
    for (const Vec3& corner : t.corner) {
      box.extend(corner);
      turned.extend(axes_ * corner);
    }
    bounds_.extend(box);
    const double size = std::max(norm_one(box.lower), norm_one(box.upper));
    triangle_boxes.push_back(is_turned ? inflated(turned, kTurnRounding * size) : box);
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
  wide_ = WideBvh(bvh_, boxes_);
}

double SurfaceTree::distance_to_face(Vec3 point, std::uint32_t face) const {
  return length(point - closest_point_of_triangle(triangles_[face], point));
}

MeshDistance SurfaceTree::distance(Vec3 point, std::uint32_t hint, double within) const {
  struct Waiting {
    std::uint32_t child;
    float squared;
  };
  const WideBvh::Distances distances(wide_, axes_ * point);
  std::array<Waiting, kWideStackSize> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, 0};
  MeshDistance best{0, hint};
  double best_squared = length_squared(point - closest_point_of_triangle(triangles_[hint], point));
  const double limit = within * within * (1 + kRounding);
  // Boxes that are farther away than this are skipped.
  const auto bound = [&] { return rounded_up(std::min(best_squared, limit)); };
  float farthest = bound();
  while (waiting > 0 && best_squared > 0) {
    const Waiting at = stack[--waiting];
    if (at.squared > farthest) continue;
    if ((at.child & WideBvh::kLeaf) != 0) {
      const std::uint32_t face = at.child & ~WideBvh::kLeaf;
      const double squared = length_squared(point - closest_point_of_triangle(triangles_[face], point));
      if (squared >= best_squared) continue;
      best_squared = squared;
      best.face = face;
      farthest = bound();
      continue;
    }
    const WideBvh::Node& node = wide_[at.child];
    float squared[WideBvh::kWidth];
    DISMANTLE_EXPECT(waiting + WideBvh::kWidth <= stack.size());
    const std::size_t begin = waiting;
    for (unsigned near = distances.within(node, farthest, squared); near != 0; near &= near - 1) {
      const int k = std::countr_zero(near);
      // The nearest one is visited first.
      std::size_t slot = waiting++;
      for (; slot > begin && stack[slot - 1].squared <= squared[k]; --slot) stack[slot] = stack[slot - 1];
      stack[slot] = {node.child[k], squared[k]};
    }
  }
  best.distance = std::sqrt(best_squared);
  return best;
}

}  // namespace dismantle
