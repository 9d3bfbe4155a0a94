// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/joint_steps.h"

#include <algorithm>

namespace dismantle {

std::optional<StraightRemoval> JointSteps::first_free(const std::vector<ComponentId>& components, DirectionId last,
                                                      const ComponentSet& present, const ComponentSet& staying) {
  for (const ComponentId c : components) {
    if (staying.has(c)) continue;
    std::vector<DirectionId> directions = choice_.directions()[c.value];
    std::stable_partition(directions.begin(), directions.end(), [&](DirectionId d) { return d == last; });
    for (const DirectionId d : directions)
      if (!table_.any_blocker(c, d, present)) return StraightRemoval{{c}, d};
  }
  return std::nullopt;
}

StraightRemoval JointSteps::with_washers(StraightRemoval removal, const ComponentSet& present,
                                         const ComponentSet& staying) {
  if (removal.components.size() != 1 || !relations_.is_fastener(removal.components.front())) return removal;
  std::vector<ComponentId> washers =
      relations_.washers_with(removal.components.front(), table_.direction(removal.direction));
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
