// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/search/local_planner.h"

#include <cstddef>
#include <vector>

namespace dismantle {

/// An axis of rotation.
struct TurnAxis {
  Vec3 point;      ///< A point of it [mm].
  Vec3 direction;  ///< Unit, of either sign.
};

/// The moves that a search for a sliding path tries, and its effort.
struct SlideMoves {
  std::vector<Vec3> directions;  ///< Unit directions of pushes; opposite ones are listed separately.
  std::vector<TurnAxis> axes;    ///< Axes of rotation, tried in both senses.
  std::size_t max_effort = 0;    ///< See MotionValidator::effort.
};

/// Searches an exit path by pushing and turning a component as far as each move goes, sliding along contacts, then from
/// the configurations reached: first from new ones far from the start. Ends when a push, or a straight motion from its
/// end, leads out, when there are no new configurations, or when the effort is spent.
/// @param moves in the assembled state
/// @param validator holds the present components, without a moving set; restored afterwards
PathSearch slide_out(MotionValidator& validator, const BlockingTable& table, ComponentId component,
                     const SlideMoves& moves, const KeepGoing& keep_going);

}  // namespace dismantle
