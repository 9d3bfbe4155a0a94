// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan.h"
#include "dismantle/planner/search/motion_validator.h"

namespace dismantle {

/// Finds by how much surfaces could grow before the motions of steps would not be free.
class StepMargins {
 public:
  /// @param pairs that touch or overlap in the assembled state; all must outlive this
  StepMargins(const Assembly& assembly, const PairStates& pairs, MotionValidator& validator)
      : assembly_(assembly), pairs_(pairs), validator_(validator) {}

  /// The margin of a step: half the smallest distance, while it moves, from its components to those of `present` that
  /// they do not touch in the assembled state. Too large by at most a quarter of the tolerance, or a two-thousandth of
  /// the length of a motion; kMaxMargin of the size of the moving set where nothing is nearer. Leaves the validator's
  /// state undefined.
  /// @param present components, those of the step among them
  /// @param way of the last, straight part [mm]
  StepMargin of(const PlanStep& step, const std::vector<ComponentId>& present, double way) const;

 private:
  const Assembly& assembly_;
  const PairStates& pairs_;
  MotionValidator& validator_;
};

/// The largest margin that is looked for, as a share of the size of the moving set.
inline constexpr double kMaxMargin = 0.1;

}  // namespace dismantle
