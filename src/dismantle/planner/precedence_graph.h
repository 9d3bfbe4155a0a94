// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/keep_going.h"
#include "dismantle/planner/plan.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Which steps of a plan have to come before which.
struct PrecedenceGraph {
  /// Of each step, those that have to be done right before it can be: without those that come before these anyway.
  /// Ascending.
  std::vector<std::vector<std::uint32_t>> before;
  /// Of each step: 0 where none comes before it, else one more than the highest of those. Steps of one rank can be done
  /// in any order, or by several people.
  std::vector<std::uint32_t> ranks;
  friend bool operator==(const PrecedenceGraph&, const PrecedenceGraph&) = default;
};

/// Found by going each step's way, with the engine, past all that the plan takes away before it. Whatever order keeps
/// to the graph holds the guarantee, as the plan itself does: what a way meets does not depend on what else is there.
/// Of ways that are not straight all counts as met whose box is near them, so that less may be allowed than could be.
/// @param keep_going once it says no, all that is not known is taken as in the plan
PrecedenceGraph precedence_graph(const Assembly& assembly, const PairStates& pairs, const Plan& plan,
                                 const CertificateOptions& options, const KeepGoing& keep_going);

/// The plan with its steps in another order. @pre `order` has each step once, bodies before their parts
Plan reordered(const Plan& plan, const std::vector<std::uint32_t>& order);

}  // namespace dismantle
