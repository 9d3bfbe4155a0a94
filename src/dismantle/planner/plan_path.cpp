// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/plan_path.h"

#include "dismantle/planner/put_aside.h"
#include "dismantle/session/session_path.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Duration of a move over the assembly's diagonal, and the shortest of any move [s].
constexpr double kTimePerDiagonal = 2;
constexpr double kMinTime = 0.2;
/// Length that a rotation by a right angle counts as, as a share of the assembly's diagonal.
constexpr double kTurnShare = 0.5;

double time_between(const Pose& a, const Pose& b, double size) {
  const double turn = std::acos(std::min(1.0, std::abs(dot(a.rotation, b.rotation)))) / std::acos(0.0) * 2;
  return kTimePerDiagonal * (length(b.position - a.position) / size + kTurnShare * turn);
}

}  // namespace

Path plan_path(const Assembly& assembly, const PairStates& pairs, const Plan& plan) {
  PairStates allowed = pairs;
  allowed.raise_allowances(plan.allowances);
  Path path = empty_path(assembly, allowed);
  const std::vector<double> distances = put_aside(assembly, plan);
  const double size = diagonal(assembled_bounds(assembly));
  std::vector<Pose> ends;  // of the steps
  std::vector<Pose> poses(assembly.components.size());
  for (std::size_t k = 0; k < plan.steps.size(); ++k) {
    const PlanStep& step = plan.steps[k];
    const Pose base = step.part_of == PlanStep::kWhole ? Pose{} : ends[step.part_of];
    std::vector<Pose> way = step.poses;
    const Pose last = way.empty() ? Pose{} : way.back();
    way.push_back({last.position + distances[k] * step.exit, last.rotation});

    Move move{"remove " + assembly[step.components.front()].name, {}, {{0, base}}};
    if (step.components.size() > 1) move.label += " and " + std::to_string(step.components.size() - 1) + " more";
    for (const ComponentId c : step.components) move.components.push_back(assembly[c].name);
    for (const Pose& pose : way) {
      const Frame& before = move.frames.back();
      const Pose next = base * pose;
      const double least = &pose == &way.back() ? kMinTime : 0;
      move.frames.push_back({before.time + std::max(least, time_between(before.pose, next, size)), next});
    }
    ends.push_back(move.frames.back().pose);
    for (const ComponentId c : step.components) poses[c.value] = ends.back();
    path.moves.push_back(std::move(move));
  }
  path.removed = removed_components(assembly, poses);
  return path;
}

}  // namespace dismantle
