// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_tree_query.h"

#include "dismantle/bvh/obb_tree.h"
#include "dismantle/math/vec3f.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/ray_crossing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// Capacity reserved for the nodes that wait at the same time.
constexpr std::size_t kUsualDepth = 64;

/// Coordinates of a vector along the axes of a box.
struct BoxCoordinates {
  double along[3];
};
BoxCoordinates box_coordinates(const Obb& box, Vec3 v) {
  return {{dot(v, to_double(box.axis[0])), dot(v, to_double(box.axis[1])), dot(v, to_double(box.third_axis()))}};
}

/// Squared distance of a point (about the tree's origin) from the box, apart from the rounding of its axes.
double box_distance_squared(const Obb& box, Vec3 point) {
  const BoxCoordinates p = box_coordinates(box, point - to_double(box.center));
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double beyond = std::max(std::abs(p.along[i]) - box.half[i], 0.0);
    sum += beyond * beyond;
  }
  return sum;
}

/// Squared distance of a node's box from which on no triangle of the node is nearer than `distance`.
double squared_cutoff(double distance, const ObbNode& node) {
  const double d = distance * (1 + kObbAxisRounding) + kObbAxisRounding * node.radius;
  return d * d;
}

/// True if the ray from `p` (about the tree's origin) along the unit vector `d` may cross the node's box.
bool ray_meets(const ObbNode& node, Vec3 p, Vec3 d) {
  const Vec3 offset = p - to_double(node.box.center);
  const BoxCoordinates from = box_coordinates(node.box, offset), by = box_coordinates(node.box, d);
  const double margin = kObbAxisRounding * (node.radius + norm_one(offset));
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double half = node.box.half[i] + margin;
    if (std::abs(by.along[i]) < kObbAxisRounding) {
      // Within the other slabs the ray moves by less than a second margin along this axis.
      if (std::abs(from.along[i]) > half + margin) return false;
      continue;
    }
    const double a = (-half - from.along[i]) / by.along[i], b = (half - from.along[i]) / by.along[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave * (1 + 1e-9);
}

/// Calls hit(face, triangle about `point`) for every face that the ray crosses. False, after some of the calls, where
/// the ray passes too near to an edge to decide.
template <class Hit>
bool for_each_hit(const SolidTree& solid, Vec3 point, Vec3 direction, const Hit& hit) {
  if (solid.tree.empty()) return true;
  const std::vector<ObbNode>& nodes = solid.tree.nodes;
  const Vec3 p = point - solid.tree.origin;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const ObbNode& node = nodes[open.back()];
    open.pop_back();
    if (!ray_meets(node, p, direction)) continue;
    if (!node.leaf()) {
      open.insert(open.end(), {node.child, node.child + 1});
      continue;
    }
    Triangle t = solid.triangle(node.child);
    for (int k = 0; k < 3; ++k) t[k] -= point;
    const RayHit result = ray_hit(direction, t);
    if (result == RayHit::Unclear) return false;
    if (result == RayHit::Hit) hit(node.child, t);
  }
  return true;
}

}  // namespace

double distance_to_bounds(const SolidTree& solid, Vec3 point) {
  if (solid.tree.empty()) return std::numeric_limits<double>::infinity();
  const ObbNode& root = solid.tree.nodes.front();
  const double d = std::sqrt(box_distance_squared(root.box, point - solid.tree.origin));
  return std::max(0.0, d * (1 - kObbAxisRounding) - kObbAxisRounding * root.radius);
}

NearestFace nearest_face(const SolidTree& solid, Vec3 point, std::uint32_t hint, double accept_below) {
  NearestFace nearest;
  if (solid.tree.empty()) return nearest;
  const auto try_face = [&](std::uint32_t face) {
    const ClosestPoints closest = closest_points_vertex_face(point, solid.triangle(face));
    const double distance = length(closest.point_b - closest.point_a);
    if (distance < nearest.distance) nearest = {distance, face};
  };
  if (hint != NearestFace::kNone) try_face(hint);

  const std::vector<ObbNode>& nodes = solid.tree.nodes;
  const Vec3 p = point - solid.tree.origin;
  std::vector<std::pair<double, std::uint32_t>> open;
  open.reserve(kUsualDepth);
  open.emplace_back(box_distance_squared(nodes[0].box, p), 0);
  while (!open.empty() && nearest.distance >= accept_below) {
    const auto [bound, i] = open.back();
    open.pop_back();
    const ObbNode& node = nodes[i];
    if (bound >= squared_cutoff(nearest.distance, node)) continue;
    if (node.leaf()) {
      try_face(node.child);
      continue;
    }
    std::pair<double, std::uint32_t> near{box_distance_squared(nodes[node.child].box, p), node.child};
    std::pair<double, std::uint32_t> far{box_distance_squared(nodes[node.child + 1].box, p), node.child + 1};
    if (far.first < near.first) std::swap(near, far);
    if (far.first < squared_cutoff(nearest.distance, nodes[far.second])) open.push_back(far);
    open.push_back(near);
  }
  return nearest;
}

std::optional<std::vector<RayCrossing>> crossings_of(const SolidTree& solid, Vec3 point, Vec3 direction) {
  std::vector<RayCrossing> crossings;
  const auto add = [&](std::uint32_t face, const Triangle& triangle) {
    const Vec3 normal = normal_unscaled(triangle);
    crossings.push_back({dot(normal, triangle[0]) / dot(normal, direction), dot(normal, direction) > 0, face});
  };
  if (!for_each_hit(solid, point, direction, add)) return std::nullopt;
  std::sort(crossings.begin(), crossings.end(),
            [](const RayCrossing& a, const RayCrossing& b) { return a.distance < b.distance; });
  return crossings;
}

bool point_in_solid(const SolidTree& solid, Vec3 point) {
  return inside_by_rays([&](Vec3 direction) -> std::optional<bool> {
    bool odd = false;
    if (!for_each_hit(solid, point, direction, [&](std::uint32_t, const Triangle&) { odd = !odd; }))
      return std::nullopt;
    return odd;
  });
}

}  // namespace dismantle
