// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/planner/explanation.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// What the commands plan and why print alike.
namespace dismantle::cli {

/// The component of that name. Errors: Usage where there is none.
Result<ComponentId> find_component(const Assembly& assembly, const std::string& name);

/// The names, the first few in full.
std::string names_text(const Assembly& assembly, const std::vector<ComponentId>& components);

nlohmann::ordered_json names_json(const Assembly& assembly, const std::vector<ComponentId>& components);
nlohmann::ordered_json explanation_json(const Assembly& assembly, const Explanation& explanation);

}  // namespace dismantle::cli
