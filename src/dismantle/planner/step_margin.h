// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/progress.h"
#include "dismantle/planner/plan.h"

namespace dismantle {

/// The largest margin that is looked for, as a share of the size of the moving set.
inline constexpr double kMaxMargin = 0.1;

/// Finds PlanStep::margin of each step of a plan: half the smallest distance, while it moves, from its components to
/// those that are still there and that they do not touch in the assembled state. Too large by at most a quarter of the
/// tolerance, or a two-thousandth of the length of a motion; kMaxMargin of the size of the moving set where nothing is
/// nearer. Steps are done side by side on the threads of the options' executor.
/// @param pairs and @param options those of the plan
/// @param progress may be empty; once it cancels, the steps that are left have no margin. Called from one thread at a
/// time.
void find_margins(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options,
                  const ProgressCallback& progress, Plan& plan);

}  // namespace dismantle
