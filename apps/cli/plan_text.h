// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/core/result.h"
#include "dismantle/planner/explanation.h"

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Output that the commands plan, why and batch share.
namespace dismantle::cli {

/// The component of a name. Errors: Usage if there is none, with names that may have been meant.
Result<ComponentId> find_component(const Assembly& assembly, const std::string& name);

/// The names as a JSON array.
nlohmann::ordered_json names_json(const Assembly& assembly, const std::vector<ComponentId>& components);
/// The additional overlap that would let a component come out, as a JSON object.
nlohmann::ordered_json overlap_json(const Assembly& assembly, const LeastOverlap& overlap);
/// An explanation as the JSON object of `why --json` and `plan --json`.
nlohmann::ordered_json explanation_json(const Assembly& assembly, const Explanation& explanation);
/// A plan as the JSON object of `plan --json`, without the time it took. @param path of the plan
nlohmann::ordered_json plan_json(const Assembly& assembly, const Plan& plan, const Path& path);

/// The fasteners of a step, for people: ", unscrew 12 turns anticlockwise, 9.6 mm ..." and ", still held by bolt".
std::string fastener_text_of(const Assembly& assembly, const PlanStep& step);

/// Number of steps by tier.
std::map<PlanTier, std::size_t> tier_counts(const Plan& plan);

}  // namespace dismantle::cli
