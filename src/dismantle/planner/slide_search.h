// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/explorer.h"

#include <cstddef>
#include <vector>

namespace dismantle {

/// An axis to turn about.
struct TurnAxis {
  Vec3 point;      ///< On it [mm].
  Vec3 direction;  ///< Unit, of either sign.
};

/// What a search for a sliding way may try.
struct SlideMoves {
  std::vector<Vec3> directions;  ///< Unit: pushed along these, either way is listed.
  std::vector<TurnAxis> axes;    ///< Turned about these, one way and the other.
};

/// Pushes and turns a component as far as each goes, along whatever is in the way (response Slide), then goes on from
/// the places reached: those first that are new and far from where it began. Ends where a push leads out.
/// @param moves of the assembled state
/// @param places from how many places it is pushed and turned before it is given up
/// @param maker what is present stands, nothing is in hand; the same after it
WaySearch slide_out(StepMaker& maker, const BlockingTable& table, ComponentId component, const SlideMoves& moves,
                    std::size_t places, const GoOn& go_on);

}  // namespace dismantle
