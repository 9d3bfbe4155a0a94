// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/precedence_graph.h"

#include <string>

namespace dismantle {

/// Where the drawing of a graph has a step's box [px].
struct StepBox {
  double x = 0, y = 0;  ///< Of its upper left corner.
  double width = 0, height = 0;
};

/// A drawing of a graph: ranks from left to right, edges as curves that pass between the boxes of other ranks.
struct PrecedenceDrawing {
  struct Edge {
    std::uint32_t from = 0, to = 0;
    std::vector<double> ys;  ///< Where it passes the middle of each rank from `from`'s to `to`'s [px].
  };
  std::vector<StepBox> boxes;   ///< Of each step.
  std::vector<double> middles;  ///< Of each rank, across [px].
  std::vector<Edge> edges;
  double width = 0, height = 0;  ///< [px]
};

/// Lays a graph out in layers: steps, and edges that pass through, are put into an order in their rank in which edges
/// cross little (each near the mean of its neighbours in the ranks beside it, swept to and fro), and as far apart as
/// they are large.
PrecedenceDrawing draw_precedence(const PrecedenceGraph& graph);

/// The drawing as SVG (well-formed XML, no script, loads nothing). Steps are numbered from 1; edges to parts of a body
/// are dashed.
std::string precedence_svg(const Assembly& assembly, const Plan& plan, const PrecedenceGraph& graph);

}  // namespace dismantle
