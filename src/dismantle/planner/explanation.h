// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/plan.h"

#include <string>

namespace dismantle {

/// Why a component does not come straight out of `present`: along the one of `directions` with the fewest blockers,
/// and of these the first that it gets clearly further along.
/// No blockers: it does come out.
/// @pre directions is not empty
Explanation explain(BlockingTable& table, ComponentId component, Span<const DirectionId> directions,
                    const ComponentSet& present);

/// "+Z" or "-X" where it is such an axis, to a thousandth; else "(0.577, -0.577, 0.577)".
std::string direction_text(const Vec3& unit);

/// One sentence: "jaw is blocked by screw along +Z (contact at (1, 2, 3)), locked with {plate}"; or that it is free.
std::string explanation_text(const Assembly& assembly, const Explanation& explanation);

}  // namespace dismantle
