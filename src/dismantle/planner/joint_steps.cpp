// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/joint_steps.h"

#include <algorithm>

namespace dismantle {

std::optional<StraightRemoval> JointSteps::first_free(const std::vector<ComponentId>& components, DirectionId last,
                                                      const ComponentSet& present, const ComponentSet& staying) {
  for (const ComponentId c : components) {
    if (staying.has(c)) continue;
    const Span<const ComponentId> group = groups_.of(c);
    ComponentSet others = present;
    others.erase(group);
    std::vector<DirectionId> directions = choice_.directions()[c.value];
    std::stable_partition(directions.begin(), directions.end(), [&](DirectionId d) { return d == last; });
    const auto is_free = [&](ComponentId member, DirectionId d) { return !table_.any_blocker(member, d, others); };
    for (const DirectionId d : directions)
      if (std::all_of(group.begin(), group.end(), [&](ComponentId member) { return is_free(member, d); }))
        return StraightRemoval{{group.begin(), group.end()}, d};
  }
  return std::nullopt;
}

StraightRemoval JointSteps::with_washers(StraightRemoval removal, const ComponentSet& present,
                                         const ComponentSet& staying) {
  const ComponentId fastener = relations_.fastener_of(removal.components);
  if (!fastener.valid()) return removal;
  std::vector<ComponentId> washers = relations_.washers_with(fastener, table_.direction(removal.direction));
  std::erase_if(washers, [&](ComponentId w) { return !present.has(w) || staying.has(w) || groups_.of(w).size() > 1; });
  ComponentSet others = present;
  others.erase(removal.components);
  others.erase(washers);
  for (const ComponentId washer : washers)
    if (!table_.any_blocker(washer, removal.direction, others)) {
      removal.components.push_back(washer);
    } else {
      others.insert(washer);
    }
  return removal;
}

}  // namespace dismantle
