// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_path.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"

#include <algorithm>
#include <string>
#include <vector>

namespace dismantle::scenes {

using Names = std::vector<std::string>;

/// The plan of an assembly, with a tolerance of 0.05 mm.
struct Planned {
  PlanScene scene;
  Plan plan;

  explicit Planned(Assembly assembly, const PlanOptions& options = {})
      : scene(plan_scene(std::move(assembly), 0.05)), plan(plan_disassembly(scene.assembly, scene.pairs, options)) {}

  /// The names of what each step moves, joined by a plus.
  Names steps() const {
    Names all;
    for (const PlanStep& step : plan.steps) {
      all.emplace_back();
      for (const ComponentId c : step.components)
        all.back() += (all.back().empty() ? "" : "+") + scene.assembly[c].name;
    }
    return all;
  }
  std::size_t place(const std::string& name) const {
    const Names all = steps();
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin());
  }
  /// The number of steps that remove a component while a fastener holds it.
  std::size_t torn() const {
    return static_cast<std::size_t>(std::count_if(plan.steps.begin(), plan.steps.end(),
                                                  [](const PlanStep& step) { return !step.still_held_by.empty(); }));
  }
  /// True if the audit holds.
  bool holds() const { return audit_path(scene.assembly, plan_path(scene.assembly, scene.pairs, plan)).holds(); }
};

}  // namespace dismantle::scenes
