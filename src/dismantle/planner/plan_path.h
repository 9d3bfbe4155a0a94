// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/planner/plan.h"

namespace dismantle {

/// The plan as a path: one move for each step; removed components are parked clear of all later moves. It passes the
/// audit.
Path plan_path(const Assembly& assembly, const PairStates& pairs, const Plan& plan);

}  // namespace dismantle
