// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/removal_search.h"

#include "dismantle/planner/search/free_component_search.h"

#include <algorithm>
#include <limits>
#include <map>
#include <mutex>
#include <queue>
#include <set>
#include <utility>

namespace dismantle {

namespace {

/// Candidate sets by size, the smallest first; ties in the order found.
struct Waiting {
  ComponentSet needed;
  std::size_t order;
  friend bool operator<(const Waiting& a, const Waiting& b) {
    if (a.needed.size() != b.needed.size()) return a.needed.size() > b.needed.size();
    return a.order > b.order;
  }
};

ComponentSet all_but(const ComponentSet& inside) {
  ComponentSet rest = ComponentSet::all(inside.universe());
  rest.erase(inside.members());
  return rest;
}

/// Best-first search for fewest_removals.
class RemovalSearch {
 public:
  RemovalSearch(BlockingTable& table, const DirectionLists& directions, const ComponentSet& present,
                const ComponentSet& never, const KeepGoing& keep_going)
      : table_(table), directions_(directions), present_(present), never_(never), keep_going_(keep_going) {}

  std::optional<ComponentSet> find(Span<const ComponentId> targets) {
    std::optional<ComponentSet> known = enough_for(targets);
    if (known) most_ = known->size();
    push(ComponentSet(present_.universe(), targets));
    while (!waiting_.empty() && keep_going_()) {
      const ComponentSet needed = waiting_.top().needed;
      if (needed.size() >= most_) break;
      waiting_.pop();
      const ComponentSet left = left_over(needed);
      ComponentSet stuck(needed.universe());
      for (const ComponentId c : needed.members())
        if (left.has(c)) stuck.insert(c);
      if (stuck.size() == 0) return needed;
      widen(needed, left, stuck);
    }
    return known;
  }

 private:
  /// A feasible set, found cheaply: everything removable is removed until the targets are, then components that blocked
  /// nothing are put back. An upper bound of the search.
  std::optional<ComponentSet> enough_for(Span<const ComponentId> targets) {
    ComponentSet left = present_;
    FreeComponentSearch search(table_, directions_, left, never_);
    std::vector<StraightRemoval> taken;
    while (left.has_any(targets)) {
      const std::vector<StraightRemoval> single = search.find(Executor(), keep_going_);
      if (single.empty() || !keep_going_()) return std::nullopt;
      for (const StraightRemoval& removal : single) {
        left.erase(removal.components);
        search.remove(removal.components);
      }
      taken.insert(taken.end(), single.begin(), single.end());
    }
    ComponentSet needed(present_.universe(), targets);
    for (std::size_t k = taken.size(); k-- > 0;) {
      const std::vector<ComponentId>& own = taken[k].components;
      for (std::size_t later = k + 1; later < taken.size() && !needed.has(own[0]); ++later)
        if (needed.has(taken[later].components[0]) && blocks_any(own, taken[later]))
          for (const ComponentId c : own) needed.insert(c);
    }
    return needed;
  }

  bool blocks_any(const std::vector<ComponentId>& fixed, const StraightRemoval& removal) {
    for (const ComponentId moving : removal.components)
      for (const ComponentId c : fixed)
        if (table_.blocks(moving, removal.direction, c)) return true;
    return false;
  }

  void push(ComponentSet needed) {
    if (needed.size() >= most_) return;
    if (known_.insert(needed.members()).second) waiting_.push({std::move(needed), known_.size()});
  }

  /// The rest of `present_` after removing members of `needed` as long as possible.
  ComponentSet left_over(const ComponentSet& needed) {
    ComponentSet left = present_;
    const ComponentSet others = all_but(needed);
    FreeComponentSearch search(table_, directions_, left, others);
    const auto remove = [&](const StraightRemoval& removal) {
      left.erase(removal.components);
      search.remove(removal.components);
    };
    while (keep_going_()) {
      const std::vector<StraightRemoval> single = search.find(Executor(), keep_going_);
      std::for_each(single.begin(), single.end(), remove);
      if (!single.empty()) continue;
      const auto body = smallest_body(table_, directions_, left, others, Executor(), keep_going_);
      if (!body) break;
      remove(*body);
    }
    return left;
  }

  /// Every feasible superset of `needed` removes one of the stuck components first, along some direction: after its
  /// blockers, or together with them.
  void widen(const ComponentSet& needed, const ComponentSet& left, const ComponentSet& stuck) {
    std::map<DirectionId, ComponentSet> ends;
    BlockingTable::Together memory(left.universe());
    const std::size_t most = std::min(left.size(), most_) - 1;
    for (const ComponentId c : stuck.members()) {
      for (const DirectionId d : directions_[c.value]) {
        if (!keep_going_()) return;
        const std::vector<ComponentId> blockers = table_.blockers(c, d, left, most_ - needed.size());
        if (never_.has_any(blockers)) continue;
        if (!stuck.has_any(blockers)) push(with(needed, blockers));
        const std::vector<ComponentId> together = table_.moving_together(
            c, d, left, ends.try_emplace(d, never_).first->second, [&] { return most; }, memory);
        if (!together.empty()) push(with(needed, together));
      }
    }
  }

  static ComponentSet with(ComponentSet set, const std::vector<ComponentId>& more) {
    for (const ComponentId c : more) set.insert(c);
    return set;
  }

  BlockingTable& table_;
  const DirectionLists& directions_;
  const ComponentSet& present_;
  const ComponentSet& never_;
  const KeepGoing& keep_going_;
  std::priority_queue<Waiting> waiting_;
  std::set<std::vector<ComponentId>> known_;
  std::size_t most_ = std::numeric_limits<std::size_t>::max();  ///< The size of the best set that is known.
};

/// The smallest body that several threads have found so far; of equal ones, that along the first direction.
class SmallestBody {
 public:
  /// @param present number of components, all of which cannot be removed
  explicit SmallestBody(std::size_t present) : size_(present) {}

  /// Bodies of another component follow: they have to be smaller than those before.
  void begin_component() { place_ = 0; }
  /// The largest body of interest along a direction. @param place of the direction among those of the component
  std::size_t most(std::size_t place) {
    const std::lock_guard lock(mutex_);
    return place < place_ ? size_ : size_ - 1;
  }
  /// Keeps a body if it is of interest; it may be empty.
  void consider(std::size_t place, StraightRemoval body) {
    const std::lock_guard lock(mutex_);
    const std::size_t size = body.components.size();
    if (size == 0 || size > size_ || (size == size_ && place >= place_)) return;
    size_ = size;
    place_ = place;
    found_ = std::move(body);
  }
  /// True if there is nothing smaller, as no single component can be removed.
  bool is_least() const { return found_ && size_ <= 2; }
  const std::optional<StraightRemoval>& found() const { return found_; }

 private:
  std::mutex mutex_;
  std::size_t size_, place_ = 0;
  std::optional<StraightRemoval> found_;
};

}  // namespace

std::optional<StraightRemoval> smallest_body(BlockingTable& table, const DirectionLists& directions,
                                             const ComponentSet& present, const ComponentSet& never,
                                             const Executor& executor, const KeepGoing& keep_going) {
  SmallestBody best(present.size());
  std::map<DirectionId, ComponentSet> ends;
  std::vector<BlockingTable::Together> memory;
  for (const ComponentId c : present.members()) {
    if (never.has(c)) continue;
    std::vector<DirectionId> ways;
    for (const DirectionId d : directions[c.value])
      if (!ends.try_emplace(d, never).first->second.has(c)) ways.push_back(d);
    while (memory.size() < ways.size()) memory.emplace_back(present.universe());
    best.begin_component();
    executor.for_each_heavy(ways.size(), [&](std::size_t i) {
      if (!keep_going()) return;
      best.consider(i, {table.moving_together(
                            c, ways[i], present, ends.find(ways[i])->second, [&] { return best.most(i); }, memory[i]),
                        ways[i]});
    });
    if (!keep_going()) return std::nullopt;
    if (best.is_least()) break;
  }
  return best.found();
}

std::optional<ComponentSet> fewest_removals(BlockingTable& table, const DirectionLists& directions,
                                            const ComponentSet& present, const ComponentSet& never,
                                            Span<const ComponentId> targets, const KeepGoing& keep_going) {
  return RemovalSearch(table, directions, present, never, keep_going).find(targets);
}

}  // namespace dismantle
