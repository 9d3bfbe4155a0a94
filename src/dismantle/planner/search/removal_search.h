// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"

#include <optional>
#include <vector>

namespace dismantle {

/// The candidate directions of each component, shape [component_count][].
using DirectionLists = std::vector<std::vector<DirectionId>>;

/// A set of components that can be removed straight along a direction.
struct StraightRemoval {
  std::vector<ComponentId> components;  ///< Moves as one body.
  DirectionId direction;                ///< Of the motion.
};

/// Some single components outside `never` that can be removed from `present`, each along its first free direction;
/// empty only if there is none or `keep_going` ends the search. Small ones are tested first, and directions without
/// predicted blockers before all others.
std::vector<StraightRemoval> free_components(BlockingTable& table, const DirectionLists& directions,
                                             const ComponentSet& present, const ComponentSet& never,
                                             const Executor& executor, const KeepGoing& keep_going);

/// The smallest set without any of `never` that can be removed from `present` as one body; of equal ones the first by
/// component and direction.
/// @param executor runs the directions of a component; the result does not depend on it
/// @pre no single component can be removed (free_components)
std::optional<StraightRemoval> smallest_body(BlockingTable& table, const DirectionLists& directions,
                                             const ComponentSet& present, const ComponentSet& never,
                                             const Executor& executor, const KeepGoing& keep_going);

/// The smallest set of components whose removal from `present` includes all `targets`: optimal for straight motions
/// along the candidate directions, of single components or of sets that move together. None if no such set was found.
/// @param never components that must stay
std::optional<ComponentSet> fewest_removals(BlockingTable& table, const DirectionLists& directions,
                                            const ComponentSet& present, const ComponentSet& never,
                                            Span<const ComponentId> targets, const KeepGoing& keep_going);

}  // namespace dismantle
