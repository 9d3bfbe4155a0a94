// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/keep_going.h"
#include "dismantle/fasteners/fastener.h"
#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/order/step_order.h"
#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/planned_assembly.h"
#include "dismantle/planner/search/motion_validator.h"

#include <functional>
#include <optional>
#include <vector>

namespace dismantle {

/// The inputs and services of in_good_order().
struct PlanOrderContext {
  const PlannedAssembly& planned;                         ///< The assembly.
  const std::vector<std::optional<Fastener>>& fasteners;  ///< find_fasteners(), or empty.
  const JointRelations& relations;                        ///< Of the plan's joints.
  BlockingTable& table;                                   ///< Relations are looked up, and tested where unknown.
  MotionValidator& validator;                             ///< For steps that pass what they did not pass before.
  OrderWeights weights;                                   ///< Of the plan.
  const Executor& executor;                               ///< Tests relations side by side.
  const KeepGoing& keep_going;                            ///< Once it returns false, the order stays as it is.
  /// Sets what depends on the components that are present when a step is made.
  const std::function<void(PlanStep& step, const ComponentSet& present)>& describe;
};

/// The steps of a plan in an order that a person would choose (best_order()): equal parts one after another, few
/// changes of direction and tool, nothing loose for long. The steps of the assembly come first, then those of each body
/// that they remove, as a section of its own. Held by every order:
/// - What a step passes straight is gone, as the blocking table knows it, and the motion is validated again where
///   components are present that were not before; what is near a curved path is gone.
/// - Fasteners come before what they hold, and stacks keep their order, where they did.
/// - A component that others enclosed comes after those without which it was exposed (Exposure).
/// - Steps of several components, curved ones, and those of enclosed components that nothing exposes come after all
///   that came before them: they are made where nothing simpler is left.
/// No step of another order is held by fasteners that do not hold it in the plan. Deterministic.
Plan in_good_order(const Plan& plan, const PlanOrderContext& context);

}  // namespace dismantle
