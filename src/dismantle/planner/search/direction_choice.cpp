// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/direction_choice.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Number of the most shared directions that are tried with every component.
constexpr std::size_t kShared = 8;
/// Weight of each next one of a component's directions, relative to the one before.
constexpr double kRankWeight = 0.9;

}  // namespace

DirectionChoice::DirectionChoice(const PlannedAssembly& planned, BlockingTable& table, const CertificateEngine& engine,
                                 const ComponentSet& staying, const Executor& executor, const KeepGoing& keep_going)
    : table_(table), contacts_(planned.size()), directions_(planned.size()) {
  std::vector<std::vector<CandidateDirection>> own(planned.size());
  executor.for_each_heavy(planned.size(), [&](std::size_t c) {
    const ComponentId id(static_cast<std::uint32_t>(c));
    if (staying.has(id) || !keep_going()) return;
    contacts_[c] = contact_normals(planned, engine, id);
    own[c] = candidate_directions(id, contacts_[c], planned.features);
  });
  std::vector<double> popularity;  // of every direction
  for (std::uint32_t c = 0; c < planned.size(); ++c) {
    double weight = 1;
    const auto vote = [&](const Vec3& direction) {
      const std::size_t index = table_.add_direction(direction).value;
      if (popularity.size() <= index) popularity.resize(index + 1);
      popularity[index] += weight;
    };
    for (const CandidateDirection& d : own[c]) {
      vote(d.direction);
      weight *= kRankWeight;
    }
    // A direction against its contacts may be free once its neighbours are gone: the plane faces of a product built
    // up in layers show where these go.
    weight = 1;
    for (const WeightedDirection& normal : planned.features[c].normals) {
      vote(normal.direction);
      vote(-normal.direction);
      weight *= kRankWeight;
    }
  }
  const std::vector<DirectionId> shared = most_popular(popularity);
  for (std::uint32_t c = 0; c < planned.size(); ++c) directions_[c] = in_order(own[c], shared);
  table_.expect_blockers(
      [this](ComponentId c, const Vec3& direction) { return neighbours_against(contacts_[c.value], direction); });
}

// A component's own directions and the shared ones, nearly equal ones once; its own are kept, as they are exact.
std::vector<DirectionId> DirectionChoice::in_order(const std::vector<CandidateDirection>& own,
                                                   const std::vector<DirectionId>& shared) {
  std::vector<DirectionId> list, rest;
  for (const CandidateDirection& d : own) (d.opens ? list : rest).push_back(table_.add_direction(d.direction));
  const auto add = [&](DirectionId d) {
    if (!one_along(list, d).valid()) list.push_back(d);
  };
  for (const DirectionId d : shared) {
    const DirectionId exact = one_along(rest, d);
    add(exact.valid() ? exact : d);
  }
  for (const DirectionId d : rest) add(d);
  return list;
}

void DirectionChoice::put_first(ComponentId c, const Vec3& direction) {
  std::vector<DirectionId>& list = directions_[c.value];
  const DirectionId added = table_.add_direction(direction), known = one_along(list, added);
  if (known.valid()) std::erase(list, known);
  list.insert(list.begin(), known.valid() ? known : added);
}

// The one of `list` that is nearly equal to `d`; invalid if there is none.
DirectionId DirectionChoice::one_along(const std::vector<DirectionId>& list, DirectionId d) const {
  const auto found = std::find_if(list.begin(), list.end(), [&](DirectionId known) {
    return length(table_.direction(known) - table_.direction(d)) < kSameDirectionAngle;
  });
  return found == list.end() ? DirectionId() : *found;
}

// The directions with the most votes; of nearly equal ones, one.
std::vector<DirectionId> DirectionChoice::most_popular(const std::vector<double>& popularity) const {
  std::vector<DirectionId> order, shared;
  for (std::uint32_t d = 0; d < popularity.size(); ++d) order.emplace_back(d);
  std::stable_sort(order.begin(), order.end(),
                   [&](DirectionId a, DirectionId b) { return popularity[a.value] > popularity[b.value]; });
  for (const DirectionId d : order)
    if (shared.size() < kShared && !one_along(shared, d).valid()) shared.push_back(d);
  return shared;
}

}  // namespace dismantle
