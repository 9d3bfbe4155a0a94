// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/precedence_graph.h"

#include <string>

namespace dismantle {

/// What a step takes away, for people: "bolt", or "lid and 2 more".
std::string step_text(const Assembly& assembly, const PlanStep& step);

/// The graph for Graphviz: a node a step, an edge from each to those that need it gone; steps of one rank side by side,
/// edges from a body to its parts dashed.
std::string precedence_dot(const Assembly& assembly, const Plan& plan, const PrecedenceGraph& graph);

/// The graph as JSON, with the tree of subassemblies: docs/formats.md, "Precedence graph".
std::string precedence_json(const Assembly& assembly, const Plan& plan, const PrecedenceGraph& graph);

}  // namespace dismantle
