// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/bvh/wide_bvh.h"
#include "dismantle/exec/executor.h"
#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/mat3.h"
#include "dismantle/narrowphase/ray_crossing.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace dismantle {

/// Distance of a point from a mesh and a triangle at that distance.
struct MeshDistance {
  double distance = 0;     ///< [mm]
  std::uint32_t face = 0;  ///< The triangle.
};

/// A mesh in its own frame with a BVH of boxes: distances of points, by branch and bound, and the triangles
/// that a ray crosses. The boxes have the axes along which most of the surface is flat, so that parts that stand at an
/// angle are bounded as tightly as others. Keeps a copy of its triangles.
class SurfaceTree {
 public:
  /// Builds the tree; the same one on every executor. @pre the mesh has a triangle
  explicit SurfaceTree(const TriangleMesh& mesh, const Executor& executor = {});

  /// The distance from `point` to the mesh, exact up to the rounding of closest_point_of_triangle().
  /// @param hint a triangle to start from: the nearer, the fewer nodes are visited
  /// @param within if the mesh is further away than this [mm], the result is some triangle that is, too
  MeshDistance distance(Vec3 point, std::uint32_t hint = 0,
                        double within = std::numeric_limits<double>::infinity()) const;
  /// A triangle of the mesh.
  const Triangle& triangle(std::uint32_t face) const { return triangles_[face]; }
  /// Number of triangles.
  std::size_t face_count() const { return triangles_.size(); }
  /// The distance from `point` to one triangle [mm].
  double distance_to_face(Vec3 point, std::uint32_t face) const;

  /// Calls visit(face, hit) for every triangle that the ray from `point` along `direction` crosses, and for every one
  /// for which rounding hides whether it does; hit is RayHit::Hit or RayHit::Unclear. Returns early, false, where
  /// visit returns false.
  template <class Visit>
  bool for_each_hit(Vec3 point, Vec3 direction, const Visit& visit) const;

  /// Calls visit(face) for every triangle whose box meets the box around points, grown by `reach` [mm]. Returns early,
  /// false, where visit returns false.
  template <class Visit>
  bool for_each_near(Span<const Vec3> points, double reach, const Visit& visit) const;

  /// The topology of the tree; the triangle of a leaf is leaf_triangle().
  const Bvh& bvh() const { return bvh_; }
  /// The axes of the boxes, as rows: a rotation; of a mesh without a better one, that of its frame.
  const Mat3& axes() const { return axes_; }
  /// The box of a node along axes() [mm].
  const Aabb& box(NodeIndex node) const { return boxes_[node]; }
  /// The middle of the box of a node [mm, frame of the mesh].
  Vec3 center(NodeIndex node) const { return transposed(axes_) * boxes_[node].center(); }
  /// The box of the mesh along the axes of its frame [mm].
  const Aabb& bounds() const { return bounds_; }

 private:
  // Descending leaves one sibling per level waiting; trees are no deeper than kBvhHeuristicDepth + log2 of the
  // triangles.
  static constexpr std::size_t kStackSize = 80;
  // The same for nodes with four children, which leave three siblings per level.
  static constexpr std::size_t kWideStackSize = 3 * kStackSize;

  Bvh bvh_;
  Mat3 axes_;
  Aabb bounds_;
  std::vector<Aabb> boxes_;          // of each node, along the axes
  WideBvh wide_;                     // the same boxes
  std::vector<Triangle> triangles_;  // of the mesh
};

template <class Visit>
bool SurfaceTree::for_each_hit(Vec3 point, Vec3 direction, const Visit& visit) const {
  const WideBvh::Ray ray(wide_, axes_ * point, axes_ * direction);
  std::array<std::uint32_t, kWideStackSize> stack;
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const WideBvh::Node& node = wide_[stack[--waiting]];
    for (unsigned met = ray.met(node); met != 0; met &= met - 1) {
      const std::uint32_t child = node.child[std::countr_zero(met)];
      if ((child & WideBvh::kLeaf) == 0) {
        DISMANTLE_EXPECT(waiting < stack.size());
        stack[waiting++] = child;
        continue;
      }
      const std::uint32_t face = child & ~WideBvh::kLeaf;
      const Triangle& t = triangles_[face];
      const RayHit hit = ray_hit(direction, {{t[0] - point, t[1] - point, t[2] - point}});
      if (hit != RayHit::Miss && !visit(face, hit)) return false;
    }
  }
  return true;
}

template <class Visit>
bool SurfaceTree::for_each_near(Span<const Vec3> points, double reach, const Visit& visit) const {
  Aabb box;
  for (const Vec3& p : points) box.extend(axes_ * p);
  box = inflated(box, reach);
  std::array<NodeIndex, kStackSize> stack;
  std::size_t waiting = 0;
  stack[waiting++] = bvh_.root();
  while (waiting > 0) {
    const NodeIndex node = stack[--waiting];
    if (!overlaps(boxes_[node], box)) continue;
    if (node < bvh_.leaf_count()) {
      if (!visit(bvh_.leaf_triangle[node])) return false;
      continue;
    }
    const BvhChildren children = bvh_.children[node - bvh_.leaf_count()];
    DISMANTLE_EXPECT(waiting + 2 <= stack.size());
    stack[waiting++] = children.right;
    stack[waiting++] = children.left;
  }
  return true;
}

}  // namespace dismantle
