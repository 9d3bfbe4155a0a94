// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/search/local_planner.h"

#include <cstddef>

namespace dismantle {

/// Searches an exit path by a rapidly-exploring random tree (LaValle, Kuffner 2001): a tree of configurations grows
/// from the nearest one towards a random pose, or from one far out a little further. A bandit (UCB1, Auer et al. 2002)
/// chooses between these and the step length by what has led to new configurations so far. Every edge is a certified
/// motion of the engine that slides along contacts, so that it is guided into narrow passages. The path found is
/// shortened by certified motions. Deterministic, except for time limits.
/// @param validator holds the present components, without a moving set; restored afterwards
/// @param max_effort see MotionValidator::effort
PathSearch sample_out(MotionValidator& validator, const BlockingTable& table, ComponentId component,
                      std::size_t max_effort, const KeepGoing& keep_going);

}  // namespace dismantle
