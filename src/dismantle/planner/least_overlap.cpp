// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/least_overlap.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace dismantle {

namespace {

/// Of the directions, those with the fewest blockers are tried, at most so many of each.
constexpr std::size_t kMaxDirections = 10, kMaxBlockers = 2;
/// How closely a depth is found: a share of itself, and of the tolerance.
constexpr double kCloseness = 0.1;
/// Share of the upper bound at which a search for a depth begins.
constexpr double kFirstShare = 0.25;

}  // namespace

std::vector<OverlapSearch::Way> OverlapSearch::ways_out(ComponentId component, Span<const DirectionId> directions,
                                                        const ComponentSet& present) {
  const Span<const ComponentId> group = table_.groups().of(component);
  ComponentSet others = present;
  others.erase(group);
  std::vector<Way> ways;
  for (const DirectionId d : directions) {
    Way way{d, {}};
    for (const ComponentId member : group)
      for (const ComponentId blocker : table_.blockers(member, d, others, kMaxBlockers + 1))
        way.blocked.emplace_back(member, blocker);
    if (!way.blocked.empty() && way.blocked.size() <= kMaxBlockers) ways.push_back(std::move(way));
  }
  std::stable_sort(ways.begin(), ways.end(),
                   [](const Way& a, const Way& b) { return a.blocked.size() < b.blocked.size(); });
  if (ways.size() > kMaxDirections) ways.resize(kMaxDirections);
  return ways;
}

std::optional<LeastOverlap> OverlapSearch::find(const std::vector<Way>& ways, double most,
                                                const KeepGoing& keep_going) const {
  std::optional<LeastOverlap> best;
  std::map<std::pair<ComponentId, ComponentId>, std::shared_ptr<const AssemblySurfaces>> prepared;
  for (const Way& way : ways) {
    LeastOverlap found{table_.direction(way.direction), 0, {}};
    for (const auto& [member, blocker] : way.blocked) {
      if (!keep_going()) return best;
      const auto pair =
          needed(member, way.direction, blocker, best ? best->more : most, keep_going, prepared[{member, blocker}]);
      if (!pair) break;
      found.more = std::max(found.more, pair->more);
      found.pairs.push_back(*pair);
    }
    if (found.pairs.size() < way.blocked.size() || (best && found.more >= best->more)) continue;
    std::stable_sort(found.pairs.begin(), found.pairs.end(),
                     [](const NeededOverlap& a, const NeededOverlap& b) { return a.more > b.more; });
    best = std::move(found);
  }
  return best;
}

std::optional<NeededOverlap> OverlapSearch::needed(ComponentId moving, DirectionId d, ComponentId fixed, double most,
                                                   const KeepGoing& keep_going,
                                                   std::shared_ptr<const AssemblySurfaces>& prepared) const {
  const ComponentPair* known = states_.find(moving, fixed);
  if (!known || (known->state != PairState::Contact && known->state != PairState::Overlapping)) return std::nullopt;
  Assembly two;
  two.components = {assembly_[moving], assembly_[fixed]};
  const Vec3 way = table_.exit_distance(moving, d) * table_.direction(d);
  CertificateOptions options = options_;
  options.prepared = prepared;
  const auto is_free = [&](double more) {
    ComponentPair pair = *known;
    pair.a = ComponentId(0);
    pair.b = ComponentId(1);
    pair.declared = pair.allowed_depth = known->allowed_depth + more;
    const CertificateEngine engine(two, {states_.tolerance, {pair}}, options);
    options.prepared = engine.surfaces();
    if (!prepared) prepared = engine.surfaces();
    return !engine.straight_contact(pair.a, pair.b, way, StraightSearch::Any);
  };
  if (!is_free(most)) return std::nullopt;
  double enough = most, too_little = 0;
  while (enough - too_little > std::max(kCloseness * enough, kCloseness * states_.tolerance) && keep_going()) {
    const double middle = too_little > 0 ? std::sqrt(too_little * enough) : kFirstShare * enough;
    (is_free(middle) ? enough : too_little) = middle;
  }
  const StraightContact first = table_.contact(moving, d, fixed).value_or(StraightContact{});
  return NeededOverlap{moving, fixed, known->allowed_depth + enough, enough, first.point};
}

}  // namespace dismantle
