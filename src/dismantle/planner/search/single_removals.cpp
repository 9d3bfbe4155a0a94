// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/single_removals.h"

#include "dismantle/planner/step_preference.h"
#include "dismantle/surface/equal_shapes.h"

#include <algorithm>
#include <optional>

namespace dismantle {

namespace {

/// Exits within this distance count as the same direction.
constexpr double kSameDirection = 1e-6;

}  // namespace

SingleRemovals::SingleRemovals(const SingleRemovalSearch& search)
    : with_(search),
      weights_(order_weights(search.options.preferences, search.options.preference_weights)),
      fasteners_(search.assembly.components.size()),
      exposure_(search.assembly, search.features) {
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
  if (joints != nullptr && before.step != nullptr) {
    const auto next = joints->next_after(*before.step, kinds(), body);
    if (const auto first = with_.joint_steps.first_free(next, before.direction, body, staying)) return {*first};
  }
  const auto is_reachable = [&](const StraightRemoval& removal) {
    return among == Among::All || std::any_of(removal.components.begin(), removal.components.end(),
                                              [&](ComponentId c) { return exposure_.is_exposed(c, body); });
  };
  FreeComponentSearch& search = joints != nullptr ? searches.by_joints : searches.by_collisions;
  std::vector<StraightRemoval> single;
  // Fasteners, and what goes on in the same direction; then what is not turned over; then anything.
  for (const double most : {0.0, weights_.direction, weights_.direction + weights_.upright}) {
    if (!single.empty()) break;
    single = search.find(with_.options.engine.executor, with_.keep_going, [&](StraightRemoval& removal) {
      if (fasteners_.has_any(removal.components)) return true;
      choose_direction(removal, body, before);
      return cost(removal.direction, before) <= most && is_reachable(removal);
    });
  }
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

double SingleRemovals::cost(DirectionId d, const Before& before) const {
  const Vec3 exit = with_.table.direction(d), last = before.step != nullptr ? before.step->exit : Vec3{};
  const bool turns_over = exit.z < -kVertical && !(last.z < -kVertical);
  return (turns_over ? weights_.upright : 0) + (length(exit - last) > kSameDirection ? weights_.direction : 0);
}

void SingleRemovals::choose_direction(StraightRemoval& removal, const ComponentSet& body, const Before& before) {
  std::vector<std::pair<double, DirectionId>> cheaper;
  const double known = cost(removal.direction, before);
  for (const DirectionId d : with_.choice.directions()[with_.table.leader_of(removal.components[0]).value])
    if (const double less = cost(d, before); less < known) cheaper.emplace_back(less, d);
  std::stable_sort(cheaper.begin(), cheaper.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ComponentSet others = body;
  if (!cheaper.empty()) others.erase(removal.components);
  for (const auto& [less, d] : cheaper)
    if (with_.keep_going() &&
        std::none_of(removal.components.begin(), removal.components.end(),
                     [&, way = d](ComponentId c) { return with_.table.any_blocker(c, way, others).has_value(); })) {
      removal.direction = d;
      return;
    }
}

}  // namespace dismantle
