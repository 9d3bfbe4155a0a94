// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/single_removals.h"

#include "dismantle/planner/step_preference.h"
#include "dismantle/surface/equal_shapes.h"

#include <algorithm>
#include <optional>

namespace dismantle {

SingleRemovals::SingleRemovals(const SingleRemovalSearch& search)
    : with_(search), fasteners_(search.assembly.components.size()), exposure_(search.assembly, search.features) {
  for (std::uint32_t c = 0; c < with_.assembly.components.size(); ++c)
    if (with_.relations.is_fastener(ComponentId(c))) fasteners_.insert(ComponentId(c));
}

BodySearches SingleRemovals::searches_in(const ComponentSet& body, const ComponentSet& staying) const {
  return {FreeComponentSearch(with_.table, with_.choice.directions(), body, staying, fasteners_),
          FreeComponentSearch(with_.table, with_.choice.directions(), body, staying)};
}

const std::vector<ComponentId>& SingleRemovals::kinds() {
  if (kinds_.empty()) kinds_ = first_of_shape(with_.assembly);
  return kinds_;
}

std::vector<StraightRemoval> SingleRemovals::find(const ComponentSet& body, const ComponentSet& staying,
                                                  BodySearches& searches, const JointRelations* joints, Among among,
                                                  const Before& before) {
  const bool by_preferences = !with_.options.preferences.empty();
  if (joints != nullptr && before.step != nullptr) {
    const auto next =
        by_preferences ? joints->rest_of_stack(*before.step, body) : joints->next_after(*before.step, kinds(), body);
    if (const auto first = with_.joint_steps.first_free(next, before.direction, body, staying)) return {*first};
  }
  const auto counts = [&](ComponentId c) {
    return among == Among::All || fasteners_.has(c) || exposure_.is_exposed(c, body);
  };
  if (by_preferences) {
    StepBefore last;
    if (before.step != nullptr) last = {before.step->components.front(), before.step->exit};
    std::vector<StraightRemoval> preferred = preferred_removals(
        {with_.table, with_.choice.directions(), kinds(), with_.options.preferences, fasteners_}, body, staying, last);
    std::erase_if(preferred, [&](const StraightRemoval& removal) { return !counts(removal.components[0]); });
    return preferred;
  }
  FreeComponentSearch& search = joints != nullptr ? searches.by_joints : searches.by_collisions;
  std::vector<StraightRemoval> single = search.find(with_.options.engine.executor, with_.keep_going, counts);
  const auto radius = [&](const StraightRemoval& removal) {
    return with_.features[with_.table.leader_of(removal.components[0]).value].radius;
  };
  std::stable_sort(single.begin(), single.end(), [&](const StraightRemoval& a, const StraightRemoval& b) {
    const bool a_is_early = fasteners_.has_any(a.components), b_is_early = fasteners_.has_any(b.components);
    if (a_is_early != b_is_early) return a_is_early;
    const bool a_goes_on = a.direction == before.direction, b_goes_on = b.direction == before.direction;
    if (a_goes_on != b_goes_on) return a_goes_on;
    return radius(a) < radius(b);
  });
  return single;
}

}  // namespace dismantle
