// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/solid_query.h"

#include "dismantle/narrowphase/closest_points.h"

#include <numeric>

namespace dismantle {

namespace {

/// Directions that no CAD model is aligned with.
constexpr Vec3 kRayDirections[] = {{0.5318, 0.3177, 0.7850},   {-0.4129, 0.8231, 0.3899},  {0.6972, -0.2213, -0.6819},
                                   {-0.2891, -0.6173, 0.7317}, {0.1733, 0.9411, -0.2903},  {-0.8839, 0.1291, -0.4495},
                                   {0.3571, -0.7919, 0.4953},  {-0.6143, -0.4337, -0.6591}};

/// Relative size below which a side of a ray cannot be told from rounding.
constexpr double kRaySideError = 1e-12;

enum class RayHit { Miss, Hit, Unclear };

/// On which side of the ray from the origin along `d` the segment a-b passes, scaled; 0 where it cannot be told.
double side(Vec3 d, Vec3 a, Vec3 b) {
  const double value = dot(d, cross(a, b));
  return std::abs(value) <= kRaySideError * norm_one(a) * norm_one(b) ? 0 : value;
}

/// Crosses the ray from the origin along `d` the triangle?
RayHit ray_hit(Vec3 d, const Triangle& t) {
  const double ab = side(d, t[0], t[1]), bc = side(d, t[1], t[2]), ca = side(d, t[2], t[0]);
  const bool some_right = ab < 0 || bc < 0 || ca<0, some_left = ab> 0 || bc > 0 || ca > 0;
  if (some_right && some_left) return RayHit::Miss;
  if (ab == 0 || bc == 0 || ca == 0) return RayHit::Unclear;
  // The line crosses; before or behind the origin, by the sign of the triangle's plane.
  const Vec3 n = normal_unscaled(t);
  const double height = dot(n, t[0]), slope = dot(n, d);
  if (std::abs(height) <= kRaySideError * norm_one(n) * norm_one(t[0]) || slope == 0) return RayHit::Unclear;
  return (height > 0) == (slope > 0) ? RayHit::Hit : RayHit::Miss;
}

/// May the ray from `p` along `d` pass through the box of the k-DOP?
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
  const Bvh& bvh = now.streams->bvh;
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
  for (const Vec3 direction : kRayDirections) {
    bool inside = false, unclear = false;
    visit_leaves(
        now, component, [&](const Kdop16& k) { return ray_meets(point, direction, k); },
        [&](NodeIndex leaf) {
          Triangle t = now.triangle(leaf);
          for (int k = 0; k < 3; ++k) t[k] -= point;
          const RayHit hit = ray_hit(direction, t);
          unclear = hit == RayHit::Unclear;
          inside = inside != (hit == RayHit::Hit);
          return !unclear;
        });
    if (!unclear) return inside;
  }
  return false;
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

std::vector<std::uint32_t> shell_vertices(const TriangleStreams& streams, ComponentId component) {
  const std::uint32_t begin = streams.vertex_begin[component.value];
  std::vector<std::uint32_t> parent(streams.vertex_begin[component.value + 1] - begin);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root_of = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const BvhComponent& range = streams.bvh.components[component.value];
  for (NodeIndex leaf = range.leaf_begin; leaf < range.leaf_end; ++leaf) {
    const Face& face = streams.faces[leaf];
    for (int k = 1; k < 3; ++k) parent[root_of(face.v[k] - begin)] = root_of(face.v[0] - begin);
  }
  std::vector<std::uint32_t> shells;
  for (std::uint32_t v = 0; v < parent.size(); ++v)
    if (parent[v] == v) shells.push_back(begin + v);
  return shells;
}

}  // namespace dismantle
