// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/moving_surface.h"

#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/ray_crossing.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace dismantle {

namespace {

/// True if the ray from `p` along `d` may pass through the box of the k-DOP (its first three slabs).
bool ray_meets(Vec3 p, Vec3 d, const Kdop16& k) {
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (k.lower[axis] - p[axis]) / d[axis], b = (k.upper[axis] - p[axis]) / d[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave * (1 + 1e-9);
}

/// Visits the leaves of a component below nodes that `enter(bounds)` accepts, until `visit(leaf)` returns false.
template <class Enter, class Visit>
void visit_leaves(const MomentaryTriangles& now, ComponentId component, Enter enter, Visit visit) {
  const Bvh& bvh = now.triangles->bvh;
  std::vector<NodeIndex> open;
  if (bvh.components[component.value].root != kNoNode) open.push_back(bvh.components[component.value].root);
  while (!open.empty()) {
    const NodeIndex node = open.back();
    open.pop_back();
    if (!enter(now.bounds[node])) continue;
    if (node < bvh.leaf_count()) {
      if (!visit(node)) return;
      continue;
    }
    const BvhChildren c = bvh.children[node - bvh.leaf_count()];
    open.push_back(c.left);
    open.push_back(c.right);
  }
}

}  // namespace

Vec3 MomentaryTriangles::vertex(std::uint32_t v) const {
  if (s == 0) return step.vertices_t0[v];
  if (s == 1) return step.vertices_t1[v];
  return (1 - s) * step.vertices_t0[v] + s * step.vertices_t1[v];
}

Triangle MomentaryTriangles::triangle(NodeIndex leaf) const {
  const Face face = step.faces[leaf];
  return {{vertex(face.v[0]), vertex(face.v[1]), vertex(face.v[2])}};
}

bool point_in_component(const MomentaryTriangles& now, Vec3 point, ComponentId component) {
  return inside_by_rays([&](Vec3 direction) -> std::optional<bool> {
    bool odd = false, unclear = false;
    visit_leaves(
        now, component, [&](const Kdop16& k) { return ray_meets(point, direction, k); },
        [&](NodeIndex leaf) {
          Triangle t = now.triangle(leaf);
          for (int k = 0; k < 3; ++k) t[k] -= point;
          const RayHit hit = ray_hit(direction, t);
          unclear = hit == RayHit::Unclear;
          odd = odd != (hit == RayHit::Hit);
          return !unclear;
        });
    if (unclear) return std::nullopt;
    return odd;
  });
}

bool surface_within(const MomentaryTriangles& now, Vec3 point, ComponentId component, double distance) {
  const double reach = distance * (1 + 1e-9) + 1e-12 * max_abs(point);
  bool found = false;
  visit_leaves(
      now, component,
      [&](const Kdop16& k) {
        for (int axis = 0; axis < 3; ++axis)
          if (k.lower[axis] > point[axis] + reach || k.upper[axis] < point[axis] - reach) return false;
        return true;
      },
      [&](NodeIndex leaf) {
        const ClosestPoints closest = closest_points_vertex_face(point, now.triangle(leaf));
        found = length(closest.point_b - closest.point_a) <= reach;
        return !found;
      });
  return found;
}

}  // namespace dismantle
