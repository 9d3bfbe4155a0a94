// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/surface_queries.h"

#include "dismantle/bvh/bvh_traverse.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dismantle {

namespace {

/// Squared distance from a point to a node's box (the first three axes of its k-DOP): never above the true one.
double box_distance_squared(const Kdop16& k, Vec3 p) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double below = static_cast<double>(k.lower[i]) - p[i], above = p[i] - static_cast<double>(k.upper[i]);
    const double d = std::max({below, above, 0.0});
    sum += d * d;
  }
  return sum;
}

double box_distance_squared(const Kdop16& a, const Kdop16& b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double below = static_cast<double>(a.lower[i]) - static_cast<double>(b.upper[i]);
    const double above = static_cast<double>(b.lower[i]) - static_cast<double>(a.upper[i]);
    const double d = std::max({below, above, 0.0});
    sum += d * d;
  }
  return sum;
}

/// The component's vertices in regions that are joined by triangles which do not cross the other component.
class VertexRegions {
 public:
  VertexRegions(const AssemblySurface& s, ComponentId component, const std::vector<NodeIndex>& crossing)
      : begin_(s.streams.vertex_begin[component.value]), parent_(s.streams.vertex_begin[component.value + 1] - begin_) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    const BvhComponent& range = s.streams.bvh.components[component.value];
    for (NodeIndex leaf = range.leaf_begin; leaf < range.leaf_end; ++leaf) {
      if (std::binary_search(crossing.begin(), crossing.end(), leaf)) continue;
      const Face& f = s.streams.faces[leaf];
      join(f.v[0], f.v[1]);
      join(f.v[0], f.v[2]);
    }
  }
  /// The vertex (a global index) that stands for the region of `vertex`.
  std::uint32_t region_of(std::uint32_t vertex) {
    std::uint32_t v = vertex - begin_;
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v + begin_;
  }

 private:
  void join(std::uint32_t a, std::uint32_t b) { parent_[region_of(a) - begin_] = region_of(b) - begin_; }

  std::uint32_t begin_;
  std::vector<std::uint32_t> parent_;
};

}  // namespace

AssemblySurface make_assembly_surface(const Assembly& assembly, const Executor& executor) {
  AssemblySurface s;
  s.streams = make_assembly_triangles(assembly, executor);
  s.bounds = bounds_at(s.streams, s.streams.vertices, 0, executor);
  return s;
}

std::vector<std::pair<ComponentId, ComponentId>> near_component_pairs(const AssemblySurface& s, double margin,
                                                                      const Executor& executor) {
  std::vector<std::pair<ComponentId, ComponentId>> pairs;
  const std::vector<Kdop16> grown = bounds_at(s.streams, s.streams.vertices, margin / 2, executor);
  bvh_traverse_components(s.streams.bvh, grown, [&](ComponentId a, ComponentId b) { pairs.emplace_back(a, b); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

SurfaceOverlap surface_overlap(const AssemblySurface& s, ComponentId a, ComponentId b) {
  SurfaceOverlap overlap;
  const NodePair start{s.root_of(a), s.root_of(b)};
  if (start.a == kNoNode || start.b == kNoNode) return overlap;
  bvh_traverse(BvhView(s.streams.bvh), s.bounds, start, [&](NodeIndex leaf_a, NodeIndex leaf_b) {
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

double surface_distance(const AssemblySurface& s, ComponentId a, ComponentId b, double limit) {
  const NodePair start{s.root_of(a), s.root_of(b)};
  if (start.a == kNoNode || start.b == kNoNode) return limit;
  const BvhView tree(s.streams.bvh);
  const auto least = [&s](NodePair p) { return box_distance_squared(s.bounds[p.a], s.bounds[p.b]); };
  double best = limit * limit;
  std::vector<std::pair<double, NodePair>> open{{least(start), start}};
  while (!open.empty()) {
    const auto [bound, pair] = open.back();
    open.pop_back();
    if (bound >= best) continue;
    if (tree.is_leaf(pair.a) && tree.is_leaf(pair.b)) {
      const double d = distance_triangle_triangle(s.leaf_triangle(pair.a), s.leaf_triangle(pair.b)).distance;
      best = std::min(best, d * d);
      continue;
    }
    NodePairChildren next = expanded(tree, s.bounds, pair);
    if (least(next.pair[0]) < least(next.pair[1]))
      std::swap(next.pair[0], next.pair[1]);  // the nearer one is taken first
    for (int k = 0; k < next.count; ++k) open.emplace_back(least(next.pair[k]), next.pair[k]);
  }
  return std::sqrt(best);
}

SurfaceDistance surface_distance(const AssemblySurface& s, ComponentId component, Vec3 point) {
  const BvhView tree(s.streams.bvh);
  SurfaceDistance nearest;
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
      if (squared >= best) continue;
      best = squared;
      nearest.leaf = node;
      continue;
    }
    BvhChildren c = tree.children_of(node);
    if (box_distance_squared(s.bounds[c.left], point) < box_distance_squared(s.bounds[c.right], point))
      std::swap(c.left, c.right);
    open.push_back(c.left);
    open.push_back(c.right);
  }
  nearest.distance = std::sqrt(best);
  return nearest;
}

double deepest_vertex(const AssemblySurface& s, ComponentId inner, ComponentId outer,
                      const std::vector<NodeIndex>& crossing) {
  const NodeIndex root = s.root_of(outer);
  if (root == kNoNode) return 0;
  VertexRegions regions(s, inner, crossing);
  enum : std::uint8_t { kUnknown, kInside, kOutside };
  const std::uint32_t begin = s.streams.vertex_begin[inner.value], end = s.streams.vertex_begin[inner.value + 1];
  std::vector<std::uint8_t> side(end - begin, kUnknown);
  for (std::uint32_t v = begin; v < end; ++v)
    if (box_distance_squared(s.bounds[root], s.streams.vertices[v]) > 0) side[regions.region_of(v) - begin] = kOutside;

  double deepest = 0;
  for (std::uint32_t v = begin; v < end; ++v) {
    std::uint8_t& region_side = side[regions.region_of(v) - begin];
    if (region_side == kUnknown)
      region_side = point_in_component(s.assembled(), s.streams.vertices[v], outer) ? kInside : kOutside;
    if (region_side == kInside) deepest = std::max(deepest, surface_distance(s, outer, s.streams.vertices[v]).distance);
  }
  return deepest;
}

}  // namespace dismantle
