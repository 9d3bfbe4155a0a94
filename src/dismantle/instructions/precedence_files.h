// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/precedence_graph.h"

#include <string>

namespace dismantle {

/// Label of a step: the components that it removes, as "bolt" or "lid and 2 more".
std::string step_text(const Assembly& assembly, const PlanStep& step);

/// The graph in DOT for Graphviz: one node per step, edges from each step to those that require it; nodes grouped by
/// rank, edges from a body to its parts dashed.
std::string precedence_dot(const Assembly& assembly, const Plan& plan, const PrecedenceGraph& graph);

/// The graph and the tree of subassemblies as JSON: docs/formats.md, "Precedence graph".
std::string precedence_json(const Assembly& assembly, const Plan& plan, const PrecedenceGraph& graph);

}  // namespace dismantle
