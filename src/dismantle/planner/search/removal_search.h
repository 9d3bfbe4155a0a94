// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"

#include <optional>
#include <vector>

namespace dismantle {

/// The directions that are considered for each component.
using DirectionLists = std::vector<std::vector<DirectionId>>;

/// A set that can go straight out of what is present.
struct StraightRemoval {
  std::vector<ComponentId> components;
  DirectionId direction;
};

/// Some single components outside `never` that come out of `present`, each along the first direction that is free; none
/// only where none does, or `keep_going` ends the search. Small ones are asked first, and all along the directions that no
/// blocker is expected in before any is along others.
std::vector<StraightRemoval> free_components(BlockingTable& table, const DirectionLists& directions,
                                             const ComponentSet& present, const ComponentSet& never,
                                             const Executor& executor, const KeepGoing& keep_going);

/// The smallest set without any of `never` that blocks itself only, so that it comes out of `present` as one body.
/// @pre no single component comes out by itself (free_components)
std::optional<StraightRemoval> smallest_body(BlockingTable& table, const DirectionLists& directions,
                                             const ComponentSet& present, const ComponentSet& never, const KeepGoing& keep_going);

/// The fewest components that must be taken out of `present` so that all `targets` come out, them included: optimal
/// for straight motions along the directions considered, of single components or of sets that go together. Nothing
/// where no such set was found.
/// @param never these must stay
std::optional<ComponentSet> fewest_removals(BlockingTable& table, const DirectionLists& directions,
                                            const ComponentSet& present, const ComponentSet& never,
                                            Span<const ComponentId> targets, const KeepGoing& keep_going);

}  // namespace dismantle
