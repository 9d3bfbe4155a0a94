// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/plan.h"

#include <string>

namespace dismantle {

/// A direction, and what blocks a component along it.
struct BlockedWay {
  DirectionId direction;          ///< In the table.
  std::vector<Blocker> blockers;  ///< Nearest first.
};

/// The direction along which the fewest of `present` block a component with its group, and of equal ones the first
/// along which it gets clearly further. Relations that the table does not test any more, since its search ended, count
/// as blocking.
/// @param executor runs the directions; the result does not depend on it
/// @pre directions is not empty
BlockedWay least_blocked_way(BlockingTable& table, ComponentId component, Span<const DirectionId> directions,
                             const ComponentSet& present, const Executor& executor);

/// Explains what blocks the straight removal of a component, with its group, from `present` along its least blocked
/// way. Without blockers it can be removed.
Explanation explain(BlockingTable& table, ComponentId component, BlockedWay way, const ComponentSet& present);

/// "+Z" or "-X" for a coordinate axis (within a thousandth), else "(0.577, -0.577, 0.577)".
std::string direction_text(const Vec3& unit);

/// The names of components, at most a few: "washer, nut, screw, screw.2 and 59 more".
std::string names_text(const Assembly& assembly, Span<const ComponentId> components);

/// "comes out along +X if 0.012 mm more overlap with bore (at (12, 0, 40)) was allowed".
std::string overlap_text(const Assembly& assembly, const LeastOverlap& overlap);

/// One sentence, with a few names at most: "jaw is blocked by screw along +Z (contact at (1, 2, 3)), interlocked with
/// plate"; or that it can be removed.
std::string explanation_text(const Assembly& assembly, const Explanation& explanation);

}  // namespace dismantle
