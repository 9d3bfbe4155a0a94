// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/keep_going.h"
#include "dismantle/fasteners/fastener.h"
#include "dismantle/planner/plan.h"
#include "dismantle/planner/planned_assembly.h"

#include <optional>
#include <vector>

namespace dismantle {

/// Sets PlanStep::is_enclosed of all steps of a plan, in their order. Once `keep_going` returns false, the rest count
/// as not enclosed.
/// @param fasteners find_fasteners(), or empty
void find_enclosed_steps(const PlannedAssembly& planned, const std::vector<std::optional<Fastener>>& fasteners,
                         const KeepGoing& keep_going, Plan& plan);

}  // namespace dismantle
