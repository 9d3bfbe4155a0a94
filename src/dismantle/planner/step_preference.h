// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/search/removal_search.h"

#include <map>
#include <string>
#include <vector>

namespace dismantle {

/// By the names that users give them: "direction", "upright", "groups", "support".
const std::map<std::string, StepPreference>& step_preferences();

/// The step before, as far as it matters for the next.
struct StepBefore {
  ComponentId component;  ///< One of those it took; invalid for the first step.
  Vec3 exit;              ///< Unit, or zero for the first step.
};

/// By what removals are compared.
struct RemovalChoice {
  BlockingTable& table;
  const DirectionLists& directions;
  const std::vector<std::uint32_t>& kinds;         ///< Equal for equal components, shape [component_count].
  const std::vector<StepPreference>& preferences;  ///< The first counts most.
};

/// All single components of `present` outside `never` that come straight out of it, along each of their directions that
/// is free, what is preferred first; of equals small ones.
std::vector<StraightRemoval> preferred_removals(const RemovalChoice& choice, const ComponentSet& present,
                                                const ComponentSet& never, const StepBefore& before);

/// A number for each component, the same for those of equal meshes.
std::vector<std::uint32_t> component_kinds(const Assembly& assembly);

}  // namespace dismantle
