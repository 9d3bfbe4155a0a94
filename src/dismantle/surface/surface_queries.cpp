// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/surface_queries.h"

#include "dismantle/bvh/bvh_traverse.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "dismantle/surface/vertex_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

/// Squared distance from a point to a node's box (the first three slabs of its k-DOP): never above the true one.
double box_distance_squared(const Kdop16& k, Vec3 p) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double below = static_cast<double>(k.lower[i]) - p[i], above = p[i] - static_cast<double>(k.upper[i]);
    const double d = std::max({below, above, 0.0});
    sum += d * d;
  }
  return sum;
}

/// Squared distance of what two nodes bound: never above the true one.
double bounds_distance_squared(const Kdop16& a, const Kdop16& b) {
  constexpr int kAxes = Kdop16::kAxisCount;
  double gap[kAxes];
  for (int k = 0; k < kAxes; ++k) {
    const double below = static_cast<double>(a.lower[k]) - static_cast<double>(b.upper[k]);
    const double above = static_cast<double>(b.lower[k]) - static_cast<double>(a.upper[k]);
    gap[k] = std::max({below, above, 0.0});
  }
  double squared = gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2];
  for (int k = 3; k < kAxes; ++k) squared = std::max(squared, gap[k] * gap[k] / 2);  // their axes are sqrt(2) long
  return squared;
}

}  // namespace

AssemblySurface make_assembly_surface(const Assembly& assembly, const Executor& executor) {
  AssemblySurface s;
  s.triangles = make_assembly_triangles(assembly, executor);
  s.bounds = bounds_at(s.triangles, s.triangles.vertices, 0, executor);
  return s;
}

std::vector<std::pair<ComponentId, ComponentId>> near_component_pairs(const AssemblyTriangles& triangles, double margin,
                                                                      const Executor& executor) {
  std::vector<std::pair<ComponentId, ComponentId>> pairs;
  const std::vector<Kdop16> grown = bounds_at(triangles, triangles.vertices, margin / 2, executor);
  bvh_traverse_components(triangles.bvh, grown, [&](ComponentId a, ComponentId b) { pairs.emplace_back(a, b); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

SurfaceOverlap surface_overlap(const AssemblySurface& s, ComponentId a, ComponentId b) {
  SurfaceOverlap overlap;
  const NodePair start{s.root_of(a), s.root_of(b)};
  if (start.a == kNoNode || start.b == kNoNode) return overlap;
  bvh_traverse(BvhView(s.triangles.bvh), s.bounds, start, [&](NodeIndex leaf_a, NodeIndex leaf_b) {
    const Triangle ta = s.leaf_triangle(leaf_a), tb = s.leaf_triangle(leaf_b);
    if (!intersect_triangle_triangle(ta, tb)) return;
    ++overlap.triangle_pairs;
    overlap.penetration = std::max(overlap.penetration, penetration_triangle_triangle(ta, tb).depth);
    overlap.leaves[0].push_back(leaf_a);
    overlap.leaves[1].push_back(leaf_b);
  });
  for (std::vector<NodeIndex>& leaves : overlap.leaves) {
    std::sort(leaves.begin(), leaves.end());
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  }
  return overlap;
}

SurfaceDistance nearest_of_surface(const AssemblySurface& s, ComponentId a, ComponentId b, double limit,
                                   double accept_below) {
  const NodePair start{s.root_of(a), s.root_of(b)};
  SurfaceDistance nearest{limit, {}};
  if (start.a == kNoNode || start.b == kNoNode) return nearest;
  const BvhView tree(s.triangles.bvh);
  const auto lower_bound = [&s](NodePair p) { return bounds_distance_squared(s.bounds[p.a], s.bounds[p.b]); };
  double best = limit * limit;  // squared
  std::vector<std::pair<double, NodePair>> open{{lower_bound(start), start}};
  while (!open.empty()) {
    const auto [bound, pair] = open.back();
    open.pop_back();
    // Where the distance is accepted, only triangles that meet are looked for.
    const bool accepted = nearest.distance < accept_below;
    if (bound >= best || (accepted && bound > 0)) continue;
    if (tree.is_leaf(pair.a) && tree.is_leaf(pair.b)) {
      const Triangle of_a = s.leaf_triangle(pair.a), of_b = s.leaf_triangle(pair.b);
      if (accepted && !intersect_triangle_triangle(of_a, of_b)) continue;
      const TriangleDistance d = distance_triangle_triangle(of_a, of_b);
      if (d.distance >= nearest.distance) continue;
      nearest = {d.distance, d.point_a};
      best = d.distance * d.distance;
      continue;
    }
    NodePairChildren next = expanded(tree, s.bounds, pair);
    // The nearer pair is taken first.
    if (lower_bound(next.pair[0]) < lower_bound(next.pair[1])) std::swap(next.pair[0], next.pair[1]);
    for (int k = 0; k < next.count; ++k) open.emplace_back(lower_bound(next.pair[k]), next.pair[k]);
  }
  return nearest;
}

double surface_distance(const AssemblySurface& s, ComponentId a, ComponentId b, double limit) {
  return nearest_of_surface(s, a, b, limit).distance;
}

double surface_distance(const AssemblySurface& s, ComponentId component, Vec3 point) {
  const BvhView tree(s.triangles.bvh);
  double best = std::numeric_limits<double>::infinity();
  std::vector<NodeIndex> open;
  if (s.root_of(component) != kNoNode) open.push_back(s.root_of(component));
  while (!open.empty()) {
    const NodeIndex node = open.back();
    open.pop_back();
    if (box_distance_squared(s.bounds[node], point) >= best) continue;
    if (tree.is_leaf(node)) {
      const ClosestPoints closest = closest_points_vertex_face(point, s.leaf_triangle(node));
      const double squared = length_squared(closest.point_a - closest.point_b);
      best = std::min(best, squared);
      continue;
    }
    BvhChildren c = tree.children_of(node);
    if (box_distance_squared(s.bounds[c.left], point) < box_distance_squared(s.bounds[c.right], point))
      std::swap(c.left, c.right);
    open.push_back(c.left);
    open.push_back(c.right);
  }
  return std::sqrt(best);
}

double deepest_vertex(const AssemblySurface& s, ComponentId inner, ComponentId outer,
                      const std::vector<NodeIndex>& crossing) {
  const NodeIndex root = s.root_of(outer);
  if (root == kNoNode) return 0;
  VertexRegions regions(s.triangles, inner, crossing);
  enum : std::uint8_t { kUnknown, kInside, kOutside };
  const std::uint32_t begin = s.triangles.vertex_begin[inner.value], end = s.triangles.vertex_begin[inner.value + 1];
  std::vector<std::uint8_t> side(end - begin, kUnknown);
  for (std::uint32_t v = begin; v < end; ++v)
    if (box_distance_squared(s.bounds[root], s.triangles.vertices[v]) > 0)
      side[regions.region_of(v) - begin] = kOutside;

  double deepest = 0;
  for (std::uint32_t v = begin; v < end; ++v) {
    std::uint8_t& region_side = side[regions.region_of(v) - begin];
    if (region_side == kUnknown)
      region_side = point_in_component(s.assembled(), s.triangles.vertices[v], outer) ? kInside : kOutside;
    if (region_side == kInside) deepest = std::max(deepest, surface_distance(s, outer, s.triangles.vertices[v]));
  }
  return deepest;
}

}  // namespace dismantle
