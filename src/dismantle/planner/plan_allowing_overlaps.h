// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan_disassembly.h"

namespace dismantle {

/// A plan, and the pairs with the allowances that it needs.
struct AllowingPlan {
  Plan plan;         ///< The plan.
  PairStates pairs;  ///< Those in the assembled state; some are declared more than they were.
};

/// Finds a disassembly sequence in which pairs of components may overlap by up to `options.overlap_limit` [mm] more
/// than plan_disassembly() lets them, where a component stays otherwise: declares what OverlapSearch finds for those
/// that stay, and plans again, until that changes nothing. The pairs have no larger allowances than are needed, to
/// within a tenth.
AllowingPlan plan_allowing_overlaps(const Assembly& assembly, const PairStates& pairs, const PlanOptions& options);

}  // namespace dismantle
