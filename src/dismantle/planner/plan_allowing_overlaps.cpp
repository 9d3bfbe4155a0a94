// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/plan_allowing_overlaps.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dismantle {

namespace {

using Clock = std::chrono::steady_clock;

/// Shortest time limit of a plan, so that one without time left reports that it ran out of time [s].
constexpr double kLeastTime = 1e-3;

}  // namespace

AllowingPlan plan_allowing_overlaps(const Assembly& assembly, const PairStates& pairs, const PlanOptions& options) {
  AllowingPlan found{{}, pairs};
  const Clock::time_point start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  for (bool allowed_more = true; allowed_more;) {
    PlanOptions left = options;
    if (options.time_limit > 0) left.time_limit = std::max(options.time_limit - seconds(), kLeastTime);
    Plan plan = plan_disassembly(assembly, found.pairs, left);
    // One that ran out of time may have got less far than the one before.
    if (found.plan.steps.empty() || !plan.out_of_time || plan.steps.size() >= found.plan.steps.size())
      found.plan = std::move(plan);
    allowed_more = false;
    if (found.plan.out_of_time) break;
    for (const Explanation& e : found.plan.staying)
      if (e.overlap)
        for (const NeededOverlap& needed : e.overlap->pairs)
          allowed_more |= found.pairs.declare(needed.moving, needed.fixed, needed.depth);
  }
  found.plan.seconds = seconds();
  return found;
}

}  // namespace dismantle
