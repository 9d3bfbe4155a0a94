// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/search/local_planner.h"

#include <cstddef>

namespace dismantle {

/// Moves a component about at random until it is out: a tree of places grows towards random poses (Rapidly-exploring
/// Random Trees, LaValle, Kuffner 2001), from the nearest place towards a pose anywhere around, or from one far out a
/// little further. Which of these, and by how much, is drawn by what has led to new places so far (a bandit: UCB1,
/// Auer et al. 2002). Every edge is a motion of the engine that slides along what is in the way, so that narrow
/// passages draw it in, and is certified as any other. The way that is found is shortened by certified motions. The
/// same for the same input, but for time limits.
/// @param validator what is present stands, nothing is in hand; the same after it
/// @param max_effort see MotionValidator::effort
PathSearch sample_out(MotionValidator& validator, const BlockingTable& table, ComponentId component, std::size_t max_effort,
                     const KeepGoing& keep_going);

}  // namespace dismantle
