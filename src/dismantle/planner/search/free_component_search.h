// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/search/removal_search.h"

#include <array>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

namespace dismantle {

/// Finds the single components, and groups of components that move together, that can be removed from a set that gets
/// smaller and smaller: as free_components(), but a component that was blocked is tested again only after one of its
/// blockers was removed.
class FreeComponentSearch {
 public:
  /// @param table, directions must outlive this @param present all that will be there @param never components that stay
  FreeComponentSearch(BlockingTable& table, const DirectionLists& directions, const ComponentSet& present,
                      const ComponentSet& never);
  /// As above. @param early components that are tested before all others
  FreeComponentSearch(BlockingTable& table, const DirectionLists& directions, const ComponentSet& present,
                      const ComponentSet& never, const ComponentSet& early);

  /// Tests those again that were blocked by a relation that was postponed (BlockingTable::postpone_hard).
  void retry_postponed();
  /// Notes that components are not there any more.
  void remove(Span<const ComponentId> components);
  /// The result of free_components() for what is there.
  std::vector<StraightRemoval> find(const Executor& executor, const KeepGoing& keep_going);
  /// As above, of those that are accepted only: the others are passed over. @param accepts (removal) -> bool; may
  /// change the direction; asked by the calling thread
  std::vector<StraightRemoval> find(const Executor& executor, const KeepGoing& keep_going,
                                    const std::function<bool(StraightRemoval&)>& accepts);

 private:
  /// The directions that a pass tests: those without a predicted blocker, or all.
  enum class Pass : std::uint8_t { Unpredicted, All };
  /// The first free direction of a component, or what blocks all of them.
  struct Found {
    DirectionId free;
    std::vector<ComponentId> blockers;
    bool postponed = false;  ///< One of the blockers counts as one because that is postponed.
    bool finished = true;    ///< False if the search was ended.
  };
  Found test(ComponentId c, Pass pass, const KeepGoing& keep_going) const;
  /// Tests those of a batch that wait.
  std::vector<StraightRemoval> test_batch(Span<const std::uint32_t> places, Pass pass, const Executor& executor,
                                          const KeepGoing& keep_going);
  /// The number of components that are there before a place in `order_`.
  std::uint32_t rank(std::uint32_t place) const;
  void count_down(std::uint32_t place);
  std::set<std::uint32_t>& waiting(Pass pass) { return waiting_[static_cast<std::size_t>(pass)]; }

  BlockingTable& table_;
  const DirectionLists& directions_;
  ComponentSet present_;
  std::vector<ComponentId> order_;                    ///< Those that may be removed, early and small ones first.
  std::vector<std::uint32_t> place_;                  ///< Of each component in `order_`; kNowhere for those that stay.
  std::vector<std::uint32_t> counts_;                 ///< Fenwick tree over `order_` of those that are there.
  std::array<std::set<std::uint32_t>, 2> waiting_;    ///< By pass: places of those that are not known to be blocked.
  std::set<std::uint32_t> postponed_;                 ///< Places of those with postponed blockers.
  std::vector<std::vector<ComponentId>> blocked_by_;  ///< By blocker: those to test again without it.
};

}  // namespace dismantle
