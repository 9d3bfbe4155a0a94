// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/order/enclosed_steps.h"

#include "dismantle/planner/search/exposure.h"

#include <algorithm>
#include <map>

namespace dismantle {

void find_enclosed_steps(const PlannedAssembly& planned, const std::vector<std::optional<Fastener>>& fasteners,
                         const KeepGoing& keep_going, Plan& plan) {
  Exposure exposure(planned.assembly, planned.features);
  std::map<std::uint32_t, ComponentSet> left;  // of each body
  for (PlanStep& step : plan.steps) {
    if (!keep_going()) return;
    ComponentSet body = step.part_of == PlanStep::kWhole
                            ? ComponentSet::all(planned.size())
                            : ComponentSet(planned.size(), plan.steps[step.part_of].components);
    ComponentSet& present = left.try_emplace(step.part_of, std::move(body)).first->second;
    step.is_enclosed = std::none_of(step.components.begin(), step.components.end(), [&](ComponentId c) {
      return (!fasteners.empty() && fasteners[c.value]) || exposure.is_exposed(c, present);
    });
    present.erase(step.components);
  }
}

}  // namespace dismantle
