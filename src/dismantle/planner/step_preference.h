// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/search/removal_search.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// Criteria by their names for users: "direction", "upright", "groups", "support", "tools", "loose".
const std::map<std::string, StepPreference>& step_preferences();

/// Criteria of a user, the most important first.
struct ChosenPreferences {
  std::vector<StepPreference> criteria;  ///< Each once.
  std::vector<double> weights;           ///< Of each; empty if none was given.
};

/// Reads criteria by their names, each with a weight above 0 or without: "groups", "groups=2.5". If some have weights,
/// the others count 1, and those that count most come first. Nothing if a name is unknown or repeated, or a weight is
/// no such number.
std::optional<ChosenPreferences> read_preferences(const std::vector<std::string>& texts);

/// The previous step, as far as criteria compare with it.
struct StepBefore {
  ComponentId component;  ///< One of the components that it removed; invalid for the first step.
  Vec3 exit;              ///< Unit, or zero for the first step.
};

/// The data for comparing removals.
struct RemovalChoice {
  BlockingTable& table;                            ///< Blocking relations.
  const DirectionLists& directions;                ///< Of each component.
  const std::vector<ComponentId>& kinds;           ///< As first_of_shape().
  const std::vector<StepPreference>& preferences;  ///< The most important first.
  const ComponentSet& early;                       ///< Components that come first where preferences are equal.
};

/// All single components of `present` outside `never` that can be removed straight, along each free direction, in order
/// of preference; ties: early ones first, then by size, small ones first.
std::vector<StraightRemoval> preferred_removals(const RemovalChoice& choice, const ComponentSet& present,
                                                const ComponentSet& never, const StepBefore& before);

}  // namespace dismantle
