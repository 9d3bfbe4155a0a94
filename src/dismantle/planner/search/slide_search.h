// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/search/local_planner.h"

#include <cstddef>
#include <vector>

namespace dismantle {

/// An axis to turn about.
struct TurnAxis {
  Vec3 point;      ///< On it [mm].
  Vec3 direction;  ///< Unit, of either sign.
};

/// What a search for a sliding way may try, and what it may cost.
struct SlideMoves {
  std::vector<Vec3> directions;  ///< Unit: pushed along these, either way is listed.
  std::vector<TurnAxis> axes;    ///< Turned about these, one way and the other.
  std::size_t max_effort = 0;    ///< See MotionValidator::effort.
};

/// Pushes and turns a component as far as each goes, along whatever is in the way (response Slide), then goes on from
/// the places reached: those first that are new and far from where it began. Ends where a push or a straight
/// way from its end leads out, where there are no new places, or with the effort.
/// @param moves of the assembled state
/// @param validator what is present stands, nothing is in hand; the same after it
PathSearch slide_out(MotionValidator& validator, const BlockingTable& table, ComponentId component, const SlideMoves& moves,
                    const KeepGoing& keep_going);

}  // namespace dismantle
