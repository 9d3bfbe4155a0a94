// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/order/plan_order.h"
#include "dismantle/planner/search/exposure.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The steps of a plan that take apart one body, numbered from 0 in the order of the plan.
struct PlanSection {
  const Plan& plan;                           ///< All steps.
  const std::vector<std::uint32_t>& members;  ///< Indices of the section's steps in it, ascending.
  const ComponentSet& body;                   ///< The components that are there before the first of them.

  /// A step of the section.
  const PlanStep& step(std::uint32_t i) const { return plan.steps[members[i]]; }
  /// Number of steps.
  std::uint32_t size() const { return static_cast<std::uint32_t>(members.size()); }
};

/// Finds what has to come before each step of a section (in_good_order()), what holds it, and what it rests on: sets
/// these members of `steps`. Steps that are before others of a step's list, as far as that is known already, may be
/// left out of it. Incomplete once context.keep_going returns false.
/// @param with_support finds OrderedStep::rests_on
void find_step_relations(const PlanSection& section, const PlanOrderContext& context, Exposure& exposure,
                         bool with_support, std::vector<OrderedStep>& steps);

}  // namespace dismantle
