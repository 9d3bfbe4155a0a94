// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/keep_going.h"
#include "dismantle/planner/joint_relations.h"
#include "dismantle/planner/plan.h"
#include "dismantle/planner/planned_assembly.h"

namespace dismantle {

/// Sets PlanStep::is_enclosed of all steps of a plan, in their order. Once `keep_going` returns false, the rest count
/// as not enclosed.
void find_enclosed_steps(const PlannedAssembly& planned, const JointRelations& relations, const KeepGoing& keep_going,
                         Plan& plan);

}  // namespace dismantle
