// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/precedence_graph.h"

#include <string>

namespace dismantle {

/// The box of a step in a drawing [px].
struct StepBox {
  double x = 0;       ///< Left edge.
  double y = 0;       ///< Upper edge.
  double width = 0;   ///< Extent along x.
  double height = 0;  ///< Extent along y.
};

/// Layered layout of a precedence graph: ranks from left to right, edges as curves that pass between the boxes of the
/// ranks that they cross.
struct PrecedenceDrawing {
  /// An edge and its route.
  struct Edge {
    std::uint32_t from = 0;  ///< Step that comes first.
    std::uint32_t to = 0;    ///< Step that requires it.
    std::vector<double> ys;  ///< Vertical position at the centre of each rank from that of `from` to that of `to` [px].
  };
  std::vector<StepBox> boxes;   ///< Shape [step_count].
  std::vector<double> centers;  ///< Horizontal position of the centre of each rank [px].
  std::vector<Edge> edges;      ///< Ordered by `to`.
  double width = 0;             ///< [px]
  double height = 0;            ///< [px]
};

/// Computes a layered layout (Sugiyama, Tagawa, Toda 1981): nodes of each rank, including dummy nodes of edges that
/// cross it, are ordered by the barycentre of their neighbours in alternating sweeps to reduce crossings, and then
/// spaced without overlap.
PrecedenceDrawing draw_precedence(const PrecedenceGraph& graph);

/// The layout as SVG: well-formed XML without scripts or external references. Steps are numbered from 1; edges from a
/// body to its parts are dashed.
std::string precedence_svg(const Assembly& assembly, const Plan& plan, const PrecedenceGraph& graph);

}  // namespace dismantle
