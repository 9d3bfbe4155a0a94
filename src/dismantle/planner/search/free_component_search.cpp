// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/free_component_search.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Number of components that are tested in parallel, the smallest first.
constexpr std::uint32_t kFewComponents = 8;
constexpr std::uint32_t kNowhere = 0xffffffffu;

}  // namespace

FreeComponentSearch::FreeComponentSearch(BlockingTable& table, const DirectionLists& directions,
                                         const ComponentSet& present, const ComponentSet& never)
    : FreeComponentSearch(table, directions, present, never, ComponentSet(present.universe())) {}

FreeComponentSearch::FreeComponentSearch(BlockingTable& table, const DirectionLists& directions,
                                         const ComponentSet& present, const ComponentSet& never,
                                         const ComponentSet& early)
    : table_(table),
      directions_(directions),
      present_(present),
      order_(present.members()),
      place_(present.universe(), kNowhere),
      blocked_by_(present.universe()) {
  std::erase_if(order_, [&](ComponentId c) { return never.has(c) || table.leader_of(c) != c; });
  std::stable_sort(order_.begin(), order_.end(), [&](ComponentId a, ComponentId b) {
    if (early.has(a) != early.has(b)) return early.has(a);
    return table.radius(a) < table.radius(b);
  });
  counts_.assign(order_.size() + 1, 0);
  for (std::uint32_t place = 0; place < order_.size(); ++place) {
    place_[order_[place].value] = place;
    for (std::set<std::uint32_t>& waiting : waiting_) waiting.insert(waiting.end(), place);
    const std::uint32_t i = place + 1;
    counts_[i] += 1;
    if (const std::uint32_t above = i + (i & -i); above < counts_.size()) counts_[above] += counts_[i];
  }
}

std::uint32_t FreeComponentSearch::rank(std::uint32_t place) const {
  std::uint32_t before = 0;
  for (std::uint32_t i = place; i > 0; i -= i & -i) before += counts_[i];
  return before;
}

void FreeComponentSearch::count_down(std::uint32_t place) {
  for (std::uint32_t i = place + 1; i < counts_.size(); i += i & -i) --counts_[i];
}

void FreeComponentSearch::remove(Span<const ComponentId> components) {
  for (const ComponentId c : components) {
    if (!present_.has(c)) continue;
    present_.erase(c);
    if (const std::uint32_t place = place_[c.value]; place != kNowhere) {
      count_down(place);
      for (std::set<std::uint32_t>& waiting : waiting_) waiting.erase(place);
      postponed_.erase(place);
    }
  }
  for (const ComponentId c : components) {
    for (const ComponentId other : blocked_by_[c.value])
      if (present_.has(other))
        for (std::set<std::uint32_t>& waiting : waiting_) waiting.insert(place_[other.value]);
    blocked_by_[c.value] = {};
  }
}

void FreeComponentSearch::retry_postponed() {
  for (std::set<std::uint32_t>& waiting : waiting_) waiting.insert(postponed_.begin(), postponed_.end());
  postponed_.clear();
}

FreeComponentSearch::Found FreeComponentSearch::test(ComponentId c, Pass pass, const KeepGoing& keep_going) const {
  const Span<const ComponentId> group = table_.groups().of(c);
  std::optional<ComponentSet> without_group;
  if (group.size() > 1) {
    without_group = present_;
    without_group->erase(group);
  }
  const ComponentSet& others = without_group ? *without_group : present_;
  Found found;
  for (const DirectionId d : directions_[c.value]) {
    std::optional<ComponentId> blocker;
    for (const ComponentId member : group) {
      if (!keep_going()) {
        found.finished = false;
        return found;
      }
      if (pass == Pass::Unpredicted) blocker = table_.expected_blocker(member, d, others);
      if (!blocker) blocker = table_.any_blocker(member, d, others);
      if (!blocker) continue;
      found.blockers.push_back(*blocker);
      found.postponed |= table_.is_postponed(member, d, *blocker);
      break;
    }
    if (blocker) continue;
    found.free = d;
    break;
  }
  return found;
}

std::vector<StraightRemoval> FreeComponentSearch::test_batch(Span<const std::uint32_t> places, Pass pass,
                                                             const Executor& executor, const KeepGoing& keep_going) {
  std::vector<Found> tested(places.size());
  executor.for_each_heavy(places.size(), [&](std::size_t i) { tested[i] = test(order_[places[i]], pass, keep_going); });
  std::vector<StraightRemoval> removals;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const ComponentId c = order_[places[i]];
    if (tested[i].free.valid()) {
      const Span<const ComponentId> group = table_.groups().of(c);
      removals.push_back({{group.begin(), group.end()}, tested[i].free});
      // Its predictions did not hold: the next time it is tested in the first pass.
      waiting(Pass::Unpredicted).insert(places[i]);
    } else if (tested[i].finished) {
      waiting(pass).erase(places[i]);
      if (tested[i].postponed) postponed_.insert(places[i]);
      for (const ComponentId blocker : tested[i].blockers) blocked_by_[blocker.value].push_back(c);
    }
  }
  return removals;
}

std::vector<StraightRemoval> FreeComponentSearch::find(const Executor& executor, const KeepGoing& keep_going) {
  return find(executor, keep_going, [](const StraightRemoval&) { return true; });
}

std::vector<StraightRemoval> FreeComponentSearch::find(const Executor& executor, const KeepGoing& keep_going,
                                                       const std::function<bool(StraightRemoval&)>& accepts) {
  for (const Pass pass : {Pass::Unpredicted, Pass::All}) {
    std::uint32_t from = 0;
    for (auto next = waiting(pass).begin(); next != waiting(pass).end() && keep_going();
         next = waiting(pass).lower_bound(from)) {
      const std::uint32_t batch = rank(*next) / kFewComponents;
      std::vector<std::uint32_t> places;
      for (; next != waiting(pass).end() && rank(*next) / kFewComponents == batch; ++next) places.push_back(*next);
      std::vector<StraightRemoval> found = test_batch(places, pass, executor, keep_going);
      std::erase_if(found, [&](StraightRemoval& removal) { return !accepts(removal); });
      if (!found.empty()) return found;
      from = places.back() + 1;
    }
  }
  return {};
}

std::vector<StraightRemoval> free_components(BlockingTable& table, const DirectionLists& directions,
                                             const ComponentSet& present, const ComponentSet& never,
                                             const Executor& executor, const KeepGoing& keep_going) {
  return FreeComponentSearch(table, directions, present, never).find(executor, keep_going);
}

}  // namespace dismantle
