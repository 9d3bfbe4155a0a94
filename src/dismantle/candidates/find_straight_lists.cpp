// SPDX-License-Identifier: Apache-2.0
#include "dismantle/candidates/find_straight_lists.h"

#include <algorithm>
#include <array>
#include <cmath>
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

/// The widest gaps between two triangles along two different axes; infinite rates where they are not apart.
/// @return the widest gap [mm]
double find_axes(const Triangle& moving, const Triangle& fixed, SeparatingAxis (&axes)[2]) {
  double size = 0;
  for (const Triangle* triangle : {&moving, &fixed})
    for (const Vec3& p : triangle->corner) size = std::max(size, length(p));
  std::array<Gap, 11> gaps;
  std::size_t count = 0;
  const auto add = [&](Vec3 direction) {
    if (const std::optional<Gap> gap = gap_along(direction, moving, fixed, kSlack * size)) gaps[count++] = *gap;
  };
  const Vec3 of_moving[3] = {moving[1] - moving[0], moving[2] - moving[1], moving[0] - moving[2]};
  const Vec3 of_fixed[3] = {fixed[1] - fixed[0], fixed[2] - fixed[1], fixed[0] - fixed[2]};
  add(cross(of_moving[0], of_moving[1]));
  add(cross(of_fixed[0], of_fixed[1]));
  for (const Vec3& edge : of_moving)
    for (const Vec3& other : of_fixed) add(cross(edge, other));
  if (count == 0) return 0;
  const Gap* widest = &gaps[0];
  for (std::size_t i = 1; i < count; ++i)
    if (gaps[i].gap > widest->gap) widest = &gaps[i];
  const Gap* other = nullptr;
  for (std::size_t i = 0; i < count; ++i)
    if (dot(gaps[i].axis, widest->axis) <= kSameAxis && (other == nullptr || gaps[i].gap > other->gap))
      other = &gaps[i];
  axes[0] = separating(*widest);
  axes[1] = other != nullptr ? separating(*other) : axes[0];
  return (1 - 1e-9) * widest->gap;
}

NearLeaves near_leaves(const CandidateScene& scene, NodePair leaves) {
  const PairRule rule = scene.rule_of(leaves);
  const GhostMotion moving = scene.moving_leaf(leaves, rule, StraightPiece(scene, {}));
  const GhostMotion fixed = scene.fixed_leaf(leaves, rule);
  NearLeaves near{leaves, 0, {}, {}};
  near.gap = std::min(find_axes(moving.ghost.t0, fixed.triangle.t0, near.of_moving_ghost),
                      find_axes(moving.triangle.t0, fixed.ghost.t0, near.of_fixed_ghost));
  return near;
}

}  // namespace

FoundStraightLists find_straight_lists(const CandidateScene& scene, std::size_t most_near) {
  FoundStraightLists found;
  std::vector<NodePair> open;
  for (const NodeIndex moving : scene.moving_roots)
    open.push_back({moving, static_cast<NodeIndex>(scene.bounds.size() - 1)});
  while (!open.empty()) {
    const NodePair p = open.back();
    open.pop_back();
    if (!scene.can_meet(p)) continue;
    const double gap = gap_of(scene.bounds[p.a], scene.bounds[p.b]);
    if (gap > 0 || found.near.size() >= most_near) {
      found.far.push_back({p, gap});
    } else if (scene.tree.is_leaf(p.a) && scene.tree.is_leaf(p.b)) {
      found.near.push_back(near_leaves(scene, p));
    } else {
      const NodePairChildren next = expanded(scene.tree, scene.bounds, p);
      for (int k = 0; k < next.count; ++k) open.push_back(next.pair[k]);
    }
  }
  const auto order = [](double gap, NodePair p) { return std::tuple(gap, p.a, p.b); };
  std::sort(found.near.begin(), found.near.end(),
            [&](const NearLeaves& x, const NearLeaves& y) { return order(x.gap, x.leaves) < order(y.gap, y.leaves); });
  std::sort(found.far.begin(), found.far.end(),
            [&](const FarNodes& x, const FarNodes& y) { return order(x.gap, x.nodes) < order(y.gap, y.nodes); });
  return found;
}

}  // namespace dismantle
