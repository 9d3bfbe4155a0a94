// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/precedence_graph.h"

#include "dismantle/core/contract.h"
#include "dismantle/math/screw.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/search/motion_validator.h"
#include "dismantle/session/session_path.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// Distance at which removed components are parked, in diagonals of the assembly.
constexpr double kFarAway = 100;
/// Length of exit motions in diagonals of the assembly: past all of it.
constexpr double kWayOut = 1.1;

Aabb bounds_of(const Assembly& assembly, const PlanStep& step, const Pose& pose) {
  Aabb box;
  for (const ComponentId c : step.components) box.extend(bounds_at(assembly[c], pose));
  return box;
}

/// Finds the components that block each step.
class PrecedenceFinder {
 public:
  PrecedenceFinder(const Assembly& assembly, const PairStates& pairs, const Plan& plan,
                   const CertificateOptions& options, const KeepGoing& keep_going)
      : assembly_(assembly),
        plan_(plan),
        size_(diagonal(assembled_bounds(assembly))),
        groups_(assembly.components.size()),
        validator_(assembly, pairs, options, groups_, kFarAway * size_, keep_going) {}

  /// All predecessors of step `k`, ascending.
  std::vector<std::uint32_t> before(std::uint32_t k) {
    const PlanStep& step = plan_.steps[k];
    std::vector<std::uint32_t> earlier, found;
    for (std::uint32_t j = 0; j < k; ++j)
      if (plan_.steps[j].part_of == step.part_of) earlier.push_back(j);
    found = step.poses.empty() ? met_straight(step, earlier) : near_way(step, earlier);
    for (const std::uint32_t j : earlier)
      if (releases(plan_.steps[j], step)) found.push_back(j);
    if (step.part_of != PlanStep::kWhole) found.push_back(step.part_of);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  /// True if an earlier step removes a fastener that holds a component of a later one, or a nut or washer of the same
  /// stack that comes off first.
  bool releases(const PlanStep& earlier, const PlanStep& later) const {
    const ComponentSet gone(assembly_.components.size(), earlier.components);
    const ComponentSet next(assembly_.components.size(), later.components);
    return std::any_of(plan_.joints.begin(), plan_.joints.end(), [&](const Joint& joint) {
      const std::vector<ComponentId> stack = joint.stack();
      const bool has_first = joint.screw.valid() ? gone.has(joint.screw) : gone.has(joint.nuts.front());
      return (has_first && next.has_any(joint.held)) || (gone.has_any(stack) && next.has_any(stack));
    });
  }

  std::vector<std::uint32_t> met_straight(const PlanStep& step, std::vector<std::uint32_t> earlier) {
    std::vector<std::uint32_t> found;
    while (!earlier.empty()) {
      ComponentSet present(assembly_.components.size(), step.components);
      for (const std::uint32_t j : earlier)
        for (const ComponentId c : plan_.steps[j].components) present.insert(c);
      validator_.stand(present);
      const MotionValidator::Trial trial = validator_.try_straight(step.components, step.exit, kWayOut * size_);
      if (trial.free) break;
      const auto is_met = [&](std::uint32_t j) {
        const ComponentSet other(assembly_.components.size(), plan_.steps[j].components);
        return trial.against.empty() ||  // a rule that names no component: it may be any of them
               std::any_of(trial.against.begin(), trial.against.end(),
                           [&](const auto& pair) { return other.has(pair.second); });
      };
      const auto first_met = std::stable_partition(earlier.begin(), earlier.end(), [&](auto j) { return !is_met(j); });
      const bool none = first_met == earlier.end();
      found.insert(found.end(), none ? earlier.begin() : first_met, earlier.end());
      earlier.erase(none ? earlier.begin() : first_met, earlier.end());
    }
    return found;
  }

  std::vector<std::uint32_t> near_way(const PlanStep& step, const std::vector<std::uint32_t>& earlier) const {
    const Aabb passed = box_around_way(assembly_, step, size_);
    std::vector<std::uint32_t> found;
    for (const std::uint32_t j : earlier)
      if (overlaps(passed, bounds_of(assembly_, plan_.steps[j], Pose{}))) found.push_back(j);
    return found;
  }

  const Assembly& assembly_;
  const Plan& plan_;
  double size_;
  RigidGroups groups_;  // what moves together is in the steps
  MotionValidator validator_;
};

/// The transitive closure: the row of a step has a 1 for each predecessor.
using Reach = std::vector<std::vector<std::uint8_t>>;

Reach reach_of(const std::vector<std::vector<std::uint32_t>>& before) {
  Reach reach(before.size(), std::vector<std::uint8_t>(before.size()));
  for (std::size_t k = 0; k < before.size(); ++k)
    for (const std::uint32_t j : before[k]) {
      reach[k][j] = 1;
      for (std::size_t i = 0; i < before.size(); ++i) reach[k][i] |= reach[j][i];
    }
  return reach;
}

}  // namespace

Aabb box_around_way(const Assembly& assembly, const PlanStep& step, double size) {
  Aabb box = bounds_of(assembly, step, Pose{});
  Pose from;
  for (const Pose& to : step.poses) {
    const Screw screw = screw_between(from, to);
    box.extend(bounds_of(assembly, step, to));
    box = inflated(box, screw_chord_deviation(screw, screw_radius(screw, box.center(), diagonal(box) / 2)));
    from = to;
  }
  box.extend(bounds_of(assembly, step, {from.position + kWayOut * size * step.exit, from.rotation}));
  return box;
}

PrecedenceGraph precedence_graph(const Assembly& assembly, const PairStates& pairs, const Plan& plan,
                                 const CertificateOptions& options, const KeepGoing& keep_going) {
  PrecedenceFinder finder(assembly, pairs, plan, options, keep_going);
  std::vector<std::vector<std::uint32_t>> all;
  all.reserve(plan.steps.size());
  for (std::uint32_t k = 0; k < plan.steps.size(); ++k) all.push_back(finder.before(k));

  const Reach reach = reach_of(all);
  PrecedenceGraph graph;
  for (const std::vector<std::uint32_t>& before : all) {
    graph.before.emplace_back();
    graph.ranks.push_back(0);
    for (const std::uint32_t j : before) {
      graph.ranks.back() = std::max(graph.ranks.back(), graph.ranks[j] + 1);
      if (std::none_of(before.begin(), before.end(), [&](std::uint32_t i) { return reach[i][j] != 0; }))
        graph.before.back().push_back(j);
    }
  }
  return graph;
}

Plan reordered(const Plan& plan, const std::vector<std::uint32_t>& order) {
  DISMANTLE_EXPECT(order.size() == plan.steps.size());
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  Plan other = plan;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    PlanStep& step = other.steps[i] = plan.steps[order[i]];
    if (step.part_of == PlanStep::kWhole) continue;
    step.part_of = place[step.part_of];
    DISMANTLE_EXPECT(step.part_of < i);
  }
  return other;
}

}  // namespace dismantle
