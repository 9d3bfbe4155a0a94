// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/order/step_order.h"
#include "dismantle/planner/plan_disassembly.h"

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

/// The weights for criteria, all others count nothing; without criteria, the usual weights.
/// @param weights of each; empty: each counts ten times as much as the next
OrderWeights order_weights(const std::vector<StepPreference>& preferences, const std::vector<double>& weights);

}  // namespace dismantle
