// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/embedded_pairs.h"

#include "dismantle/bvh/bvh_traverse.h"
#include "dismantle/geometry/aabb_corners.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Upper bound of the displacement of a point of the box from one transform to the other [mm]: that of a corner is the
/// largest.
double max_displacement(const Aabb& box, const RigidTransform& start, const RigidTransform& end) {
  if (box.empty()) return 0;
  double longest = 0;
  for (const Vec3& corner : corners_of(box)) longest = std::max(longest, length(end * corner - start * corner));
  return longest * (1 + 1e-9);
}

/// The interval of the times at which a pair is tried as parted.
double interval_of(const EmbeddedMotion& motion) {
  constexpr double kMaxTimes = 4096;
  return std::max(1 / kMaxTimes, kPartingShare * motion.tolerance / std::max(motion.displacement, motion.tolerance));
}

/// True if the two have no relative motion.
bool move_as_one(Span<const RigidTransform> start, Span<const RigidTransform> end, ComponentId a, ComponentId b) {
  const bool both_still = start[a.value] == end[a.value] && start[b.value] == end[b.value];
  return both_still || (start[a.value] == start[b.value] && end[a.value] == end[b.value]);
}

}  // namespace

EmbeddedPairs::EmbeddedPairs(const Assembly& assembly, const PairStates& states) : tolerance_(states.tolerance) {
  for (const Component& c : assembly.components) {
    closed_.push_back(c.faults.closed());
    boxes_.push_back(assembled_bounds(c));
  }
  for (const ComponentPair& pair : states.pairs)
    if (pair.state == PairState::Free) pairs_.push_back(pair);
}

bool EmbeddedPairs::any_moves(Span<const RigidTransform> start, Span<const RigidTransform> end) const {
  return std::any_of(pairs_.begin(), pairs_.end(),
                     [&](const ComponentPair& pair) { return !move_as_one(start, end, pair.a, pair.b); });
}

EmbeddedMotion EmbeddedPairs::motion(const ComponentPair& pair, const EmbeddedStep& step) const {
  EmbeddedMotion motion;
  motion.streams = step.streams;
  motion.step = step.triangles;
  motion.bounds = step.bounds;
  motion.a = pair.a;
  motion.b = pair.b;
  motion.a_closed = closed_[pair.a.value];
  motion.b_closed = closed_[pair.b.value];
  for (const ComponentId c : {pair.a, pair.b})
    motion.displacement += max_displacement(boxes_[c.value], step.start[c.value], step.end[c.value]);
  motion.tolerance = tolerance_;
  motion.path_deviation = step.path_deviation;
  return motion;
}

std::vector<PartingPair> EmbeddedPairs::parting(const EmbeddedStep& step, Span<const std::uint64_t> triangle_pairs,
                                                Span<const std::uint64_t> intersecting) const {
  const Span<const std::uint32_t> component_of = step.streams->bvh.component_of;
  std::vector<PartingPair> found;
  for (const ComponentPair& pair : pairs_) {
    if (move_as_one(step.start, step.end, pair.a, pair.b)) continue;
    EmbeddedMotion moving = motion(pair, step);
    std::vector<std::uint64_t> at_end = triangle_pairs_of(intersecting, component_of, pair.a, pair.b);
    std::sort(at_end.begin(), at_end.end());
    moving.intersecting_at_end = at_end;
    if (pierced_throughout(moving)) continue;
    std::vector<std::uint64_t> own = triangle_pairs_of(triangle_pairs, component_of, pair.a, pair.b);
    moving.triangle_pairs = own;
    if (const std::optional<double> from = parted_from(moving))
      found.push_back({pair, *from, interval_of(moving), std::move(own)});
  }
  return found;
}

std::vector<ComponentPair> EmbeddedPairs::apart(const EmbeddedStep& step) const {
  const Bvh& bvh = step.streams->bvh;
  std::vector<ComponentPair> found;
  for (const ComponentPair& pair : pairs_) {
    std::vector<std::uint64_t> own;
    const NodeIndex root_a = bvh.components[pair.a.value].root, root_b = bvh.components[pair.b.value].root;
    if (root_a != kNoNode && root_b != kNoNode)
      bvh_traverse(BvhView(bvh), step.bounds, {root_a, root_b},
                   [&](NodeIndex a, NodeIndex b) { own.push_back(pair_key(a, b)); });
    EmbeddedMotion standing = motion(pair, step);
    standing.triangle_pairs = own;
    if (!components_intersect(standing, 0)) found.push_back(pair);
  }
  return found;
}

void EmbeddedPairs::part(const std::vector<ComponentPair>& parted) {
  for (const ComponentPair& pair : parted)
    std::erase_if(pairs_, [&](const ComponentPair& e) { return e.a == pair.a && e.b == pair.b; });
}

std::vector<std::uint64_t> triangle_pairs_of(Span<const std::uint64_t> triangle_pairs,
                                             Span<const std::uint32_t> component_of, ComponentId a, ComponentId b) {
  std::vector<std::uint64_t> keys;
  for (const std::uint64_t key : triangle_pairs) {
    const NodePair p = pair_of_key(key);
    if (component_of[p.a] == a.value && component_of[p.b] == b.value) keys.push_back(key);
  }
  return keys;
}

}  // namespace dismantle
