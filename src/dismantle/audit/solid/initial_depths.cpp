// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/move_depths.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace dismantle::audit {

namespace {

/// Error bound of depths in units of rounding of the largest coordinate in their computation.
constexpr double kRoundingUnits = 32;

/// How exactly depths at the start are found, and for how many pieces: coarser where that takes too long.
struct Accuracy {
  double slack = 0;  // in tolerances; the first one is that of the audit
  double growth = 1;
  std::size_t max_pieces = 0;
};
constexpr Accuracy kAccuracies[] = {{0, 1.002, 300000}, {0.5, 1.02, 300000}, {1, 1.1, 0}};
/// A winding number of a mesh with this many open edges costs about as much as the rest of a piece.
constexpr std::size_t kEdgesPerPiece = 32;

/// The depth of the points of one side at the start.
DepthFindings initial_depth(const DepthContext& context, std::pair<std::uint32_t, std::uint32_t> pair, bool of_b) {
  const double tolerance = context.path.tolerance;
  DepthFindings found;
  std::size_t pieces = 0;
  const std::size_t open_edges = context.bodies[of_b ? pair.first : pair.second]->open_edges().size();
  for (const Accuracy& accuracy : kAccuracies) {
    DepthGoal goal{tolerance, context.slack, accuracy.growth};
    if (accuracy.slack > 0) {  // a sample that is deeper than the tolerance still counts
      goal.slack = accuracy.slack * tolerance;
      goal.floor = tolerance - goal.slack / 2;
    }
    goal.max_pieces = accuracy.max_pieces / (1 + open_edges / kEdgesPerPiece);
    found = search_assembled(context, pair, of_b, goal);
    found.samples = pieces += found.samples;
    if (found.complete) break;
  }
  return found;
}

/// The pairs whose boxes overlap in the assembled state, by (a, b).
std::vector<std::pair<std::uint32_t, std::uint32_t>> overlapping_boxes(const Assembly& assembly) {
  std::vector<Aabb> boxes;
  for (const Component& component : assembly.components) boxes.push_back(assembled_bounds(component));
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return boxes[i].lower.x < boxes[j].lower.x; });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].lower.x <= boxes[order[i]].upper.x; ++j)
      if (overlaps(boxes[order[i]], boxes[order[j]])) pairs.push_back(std::minmax(order[i], order[j]));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

DepthPair make_depth_pair(const DepthContext& context, std::pair<std::uint32_t, std::uint32_t> a_and_b,
                          const Pose& pose_a, const std::vector<MotionSegment>& segments) {
  DepthPair pair;
  pair.a = context.bodies[a_and_b.first].get();
  pair.b = context.bodies[a_and_b.second].get();
  pair.motion.a = &pair.a->surface();
  pair.motion.b = &pair.b->surface();
  const RigidTransform world_from_a = pair.motion.a->world_from_body(pose_a);
  double position = max_abs(pose_a.position);
  for (const MotionSegment& segment : segments) {
    pair.motion.motions.push_back(
        relative_motion(world_from_a, pair.motion.b->world_from_body(segment.start), segment.screw));
    position = std::max(position, max_abs(segment.start.position));
  }
  pair.motion.rounding = kRoundingUnits * std::numeric_limits<double>::epsilon() *
                         (pair.motion.a->coordinate_bound() + pair.motion.b->coordinate_bound() + 2 * position);
  return pair;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> free_pairs(const Assembly& assembly, const Path& path) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const PathPair& pair : path.pairs) {
    const auto a = assembly.find(pair.a), b = assembly.find(pair.b);
    if (a && b && pair.state == PathPairState::Free) pairs.push_back(std::minmax(a->value, b->value));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::optional<InitialDepths> find_initial_depths(const DepthContext& context,
                                                 Span<const std::pair<std::uint32_t, std::uint32_t>> free,
                                                 double progress_from, double progress_to) {
  auto pairs = overlapping_boxes(context.assembly);
  std::erase_if(pairs, [&](const auto& pair) { return std::binary_search(free.begin(), free.end(), pair); });
  std::vector<DepthFindings> found(2 * pairs.size());
  const bool completed = context.run(found.size(), progress_from, progress_to, [&](std::size_t i) {
    found[i] = initial_depth(context, pairs[i / 2], i % 2 == 1);
  });
  if (!completed) return {};
  InitialDepths depths;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const DepthFindings& of_a = found[2 * i];
    const DepthFindings& of_b = found[2 * i + 1];
    depths.pieces += of_a.samples + of_b.samples;
    if (of_a.first.depth == 0 && of_b.first.depth == 0) continue;
    depths.overlapping.push_back(
        {pairs[i], std::max(of_a.first.depth > 0 ? of_a.bound : 0, of_b.first.depth > 0 ? of_b.bound : 0)});
  }
  return depths;
}

void enter_initial_depths(DepthContext& context, const InitialDepths& depths) {
  context.pieces += depths.pieces;
  for (const InitialDepth& initial : depths.overlapping) {
    AuditPair& pair = context.ledger[initial.pair].pair;
    pair.a = ComponentId(initial.pair.first);
    pair.b = ComponentId(initial.pair.second);
    pair.initial_depth = initial.depth;
    pair.allowed = pair.initial_depth + context.path.tolerance;
  }
}

DepthFindings search_assembled(const DepthContext& context, std::pair<std::uint32_t, std::uint32_t> a_and_b, bool of_b,
                               const DepthGoal& goal) {
  if (context.bodies[a_and_b.first]->surface().empty() || context.bodies[a_and_b.second]->surface().empty()) return {};
  const std::vector<MotionSegment> still = {MotionSegment{}};
  const DepthPair pair = make_depth_pair(context, a_and_b, Pose{}, still);
  return search_depth(pair, motion_spans(still, 0, 1, pair.b->surface()), of_b, goal);
}

}  // namespace dismantle::audit
