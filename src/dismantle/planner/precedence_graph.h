// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/keep_going.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/planner/plan.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The precedence relation of the steps of a plan.
struct PrecedenceGraph {
  /// The direct predecessors of each step (transitively reduced), ascending.
  std::vector<std::vector<std::uint32_t>> before;
  /// The rank of each step: 0 without predecessors, else one more than the highest rank of those. Steps of equal rank
  /// can be done in any order, or by several people.
  std::vector<std::uint32_t> ranks;
  friend bool operator==(const PrecedenceGraph&, const PrecedenceGraph&) = default;
};

/// Computed by sweeping each step's path, with the engine, against everything that the plan removes before it; a
/// fastener precedes what it holds (Plan::joints), and a stack keeps its order. Every
/// order that respects the graph holds the guarantee, as contacts of a path do not depend on what else is present. For
/// paths that are not straight, every component whose bounding box is near counts as met, so that the relation may be
/// stricter than necessary.
/// @param keep_going once it returns false, unknown relations follow the order of the plan
PrecedenceGraph precedence_graph(const Assembly& assembly, const PairStates& pairs, const Plan& plan,
                                 const CertificateOptions& options, const KeepGoing& keep_going);

/// A box around everything that a step's components pass on their way, and straight on by 1.1 times `size` [mm,
/// assembly frame].
Aabb box_around_way(const Assembly& assembly, const PlanStep& step, double size);

/// The plan with its steps in another order. @pre `order` has each step once, bodies before their parts
Plan reordered(const Plan& plan, const std::vector<std::uint32_t>& order);

}  // namespace dismantle
