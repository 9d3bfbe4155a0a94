// SPDX-License-Identifier: Apache-2.0
#include "dismantle/candidates/find_near_lists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

namespace dismantle {

namespace {

/// Gaps are shortened by this share of all positions that enter them: far more than their rounding.
constexpr double kSlack = OverlapTimes::kRounding;
/// Two axes that are nearer to each other than this cosine say the same.
constexpr double kSameAxis = 0.99;

/// Lower bound of the distance of two bounds [mm]; 0 where they overlap.
double gap_of(const Kdop16& a, const Kdop16& b) {
  double gap = 0;
  for (int k = 0; k < Kdop16::kAxisCount; ++k) {
    const double above = static_cast<double>(a.lower[k]) - b.upper[k];
    const double below = static_cast<double>(b.lower[k]) - a.upper[k];
    // Diagonal axes are sqrt(2) long.
    gap = std::max(gap, (k < 3 ? 1 : std::sqrt(0.5)) * std::max(above, below));
  }
  return (1 - 1e-9) * gap;
}

struct Extent {
  double lower, upper;
};

Extent extent_along(Vec3 axis, const Triangle& triangle) {
  const double x = dot(axis, triangle[0]), y = dot(axis, triangle[1]), z = dot(axis, triangle[2]);
  return {std::min({x, y, z}), std::max({x, y, z})};
}

/// A unit vector from the stationary triangle to the moving one, and the gap along it [mm].
struct Gap {
  Vec3 axis;
  double gap = 0;
};

/// The gap along an axis; nothing where there is none. @param rounding by which it is shortened [mm]
std::optional<Gap> gap_along(Vec3 direction, const Triangle& moving, const Triangle& fixed, double rounding) {
  const double norm = length(direction);
  if (!(norm > 0)) return std::nullopt;
  const Vec3 axis = (1 / norm) * direction;
  const Extent a = extent_along(axis, moving), b = extent_along(axis, fixed);
  const double above = a.lower - b.upper, below = b.lower - a.upper;
  const double gap = std::max(above, below) - rounding;
  if (!(gap > 0)) return std::nullopt;
  return Gap{above >= below ? axis : -1.0 * axis, gap};
}

SeparatingAxis separating(const Gap& gap) {
  return {(1 / gap.gap) * gap.axis, kSlack / gap.gap};
}

/// Finds the axes between two triangles: those of the widest gaps along two different directions, and the normals.
/// @return the widest gap [mm]; 0, and infinite rates, where they are not apart
double find_axes(const Triangle& moving, const Triangle& fixed, AxisPair& widest, AxisPair& normals) {
  double size = 0;
  for (const Triangle* triangle : {&moving, &fixed})
    for (const Vec3& p : triangle->corner) size = std::max(size, length(p));
  const Vec3 of_moving[3] = {moving[1] - moving[0], moving[2] - moving[1], moving[0] - moving[2]};
  const Vec3 of_fixed[3] = {fixed[1] - fixed[0], fixed[2] - fixed[1], fixed[0] - fixed[2]};
  std::array<Gap, 17> gaps;
  std::size_t count = 0;
  const auto add = [&](Vec3 direction) {
    if (const std::optional<Gap> gap = gap_along(direction, moving, fixed, kSlack * size)) gaps[count++] = *gap;
  };
  const Vec3 normal_of_moving = cross(of_moving[0], of_moving[1]), normal_of_fixed = cross(of_fixed[0], of_fixed[1]);
  add(normal_of_moving);
  add(normal_of_fixed);
  const std::size_t normal_count = count;
  for (const Vec3& edge : of_moving)
    for (const Vec3& other : of_fixed) add(cross(edge, other));
  // Triangles of one plane are separated within it.
  for (const Vec3& edge : of_moving) add(cross(edge, normal_of_moving));
  for (const Vec3& other : of_fixed) add(cross(other, normal_of_fixed));
  if (count == 0) return 0;
  const Gap* most = &gaps[0];
  for (std::size_t i = 1; i < count; ++i)
    if (gaps[i].gap > most->gap) most = &gaps[i];
  const Gap* other = most;
  for (std::size_t i = 0; i < count; ++i)
    if (dot(gaps[i].axis, most->axis) <= kSameAxis && (other == most || gaps[i].gap > other->gap)) other = &gaps[i];
  widest = {{separating(*most), separating(*other)}};
  for (std::size_t i = 0; i < 2; ++i) normals.axes[i] = i < normal_count ? separating(gaps[i]) : widest.axes[i];
  return (1 - 1e-9) * most->gap;
}

/// Leaves as the lists have them.
struct Listed {
  NearLeaves near;
  NearNormals normals;
};

Listed listed_leaves(const CandidateScene& scene, NodePair leaves) {
  const PairRule rule = scene.rule_of(leaves);
  const GhostMotion moving = scene.moving_leaf(leaves, rule, StraightPiece(scene, {}));
  const GhostMotion fixed = scene.fixed_leaf(leaves, rule);
  Listed listed{{leaves, 0, {}, {}}, {}};
  NearLeaves& near = listed.near;
  near.gap =
      std::min(find_axes(moving.ghost.t0, fixed.triangle.t0, near.of_moving_ghost, listed.normals.of_moving_ghost),
               find_axes(moving.triangle.t0, fixed.ghost.t0, near.of_fixed_ghost, listed.normals.of_fixed_ghost));
  return listed;
}

double level_of(const Triangle& fixed, const SeparatingAxis& axis) {
  if (!axis.separates()) return 0;
  double level = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : fixed.corner) {
    const Vec3 size = absolute(p);
    level = std::max(level, dot(axis.normal, p) + axis.slack * (size.x + size.y + size.z));
  }
  return level;
}

NearLevels near_levels(const CandidateScene& scene, const NearLeaves& near) {
  const GhostMotion fixed = scene.fixed_leaf(near.leaves, scene.rule_of(near.leaves));
  NearLevels levels;
  for (int k = 0; k < 2; ++k) {
    levels.of_moving_ghost[k] = level_of(fixed.triangle.t0, near.of_moving_ghost.axes[k]);
    levels.of_fixed_ghost[k] = level_of(fixed.ghost.t0, near.of_fixed_ghost.axes[k]);
  }
  return levels;
}

/// Nodes by the lower bound of their distance, then by their numbers.
struct NearestFirst {
  bool operator()(const FarNodes& x, const FarNodes& y) const {
    return std::tuple(x.gap, x.nodes.a, x.nodes.b) > std::tuple(y.gap, y.nodes.a, y.nodes.b);
  }
};

/// The nodes that may meet and have not been opened, the nearest first.
class Opened {
 public:
  explicit Opened(const CandidateScene& scene) : scene_(scene) {}

  void add(NodePair p) {
    if (!scene_.can_meet(p)) return;
    nodes_.push_back({p, gap_of(scene_.bounds[p.a], scene_.bounds[p.b])});
    std::push_heap(nodes_.begin(), nodes_.end(), NearestFirst{});
  }
  bool empty() const { return nodes_.empty(); }
  const FarNodes& nearest() const { return nodes_.front(); }
  NodePair take() {
    std::pop_heap(nodes_.begin(), nodes_.end(), NearestFirst{});
    const NodePair p = nodes_.back().nodes;
    nodes_.pop_back();
    return p;
  }
  /// All of them. To be called last.
  std::vector<FarNodes> taken_all() {
    std::sort_heap(nodes_.begin(), nodes_.end(), NearestFirst{});
    std::reverse(nodes_.begin(), nodes_.end());
    return std::move(nodes_);
  }

 private:
  const CandidateScene& scene_;
  std::vector<FarNodes> nodes_;
};

}  // namespace

FoundNearLists find_near_lists(const CandidateScene& scene, const Executor& executor, const NearLimits& limits) {
  std::vector<NodePair> near;
  Opened opened(scene);
  for (const NodeIndex moving : scene.moving_roots)
    opened.add({moving, static_cast<NodeIndex>(scene.bounds.size() - 1)});
  std::size_t limit = limits.most;
  bool apart = false;
  while (!opened.empty() && near.size() < limit) {
    if (!apart && opened.nearest().gap > 0) {
      apart = true;
      limit = std::min(limit, near.size() + near.size() / 2 + limits.apart);
    }
    const NodePair p = opened.take();
    if (scene.tree.is_leaf(p.a) && scene.tree.is_leaf(p.b)) {
      near.push_back(p);
    } else {
      const NodePairChildren next = expanded(scene.tree, scene.bounds, p);
      for (int k = 0; k < next.count; ++k) opened.add(next.pair[k]);
    }
  }
  std::vector<Listed> listed(near.size());
  executor.for_each(near.size(), [&](std::size_t i) { listed[i] = listed_leaves(scene, near[i]); });
  std::vector<std::size_t> order(near.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const NearLeaves &x = listed[i].near, &y = listed[j].near;
    return std::tuple(x.gap, x.leaves.a, x.leaves.b) < std::tuple(y.gap, y.leaves.a, y.leaves.b);
  });
  FoundNearLists found{std::vector<NearLeaves>(near.size()), std::vector<NearNormals>(near.size()),
                       std::vector<NearLevels>(near.size()), opened.taken_all()};
  executor.for_each(near.size(), [&](std::size_t i) {
    found.near[i] = listed[order[i]].near;
    found.normals[i] = listed[order[i]].normals;
    found.levels[i] = near_levels(scene, found.near[i]);
  });
  return found;
}

}  // namespace dismantle
