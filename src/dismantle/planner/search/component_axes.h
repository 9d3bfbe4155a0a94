// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/revolution_axes.h"
#include "dismantle/features/thread_axes.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/planned_assembly.h"
#include "dismantle/planner/search/direction_choice.h"
#include "dismantle/planner/search/motion_validator.h"
#include "dismantle/planner/search/screw_search.h"
#include "dismantle/planner/search/slide_search.h"

#include <optional>
#include <vector>

namespace dismantle {

/// The axes about which components can turn, in their assembled poses: of surfaces of revolution and of threads.
/// Computed on first use and kept.
class ComponentAxes {
 public:
  /// @param validator must outlive this
  ComponentAxes(const PlannedAssembly& planned, MotionValidator& validator);

  /// The threads that a component shares with others: those modelled in both meshes, or else those that their
  /// contacting faces reveal.
  const std::vector<NeighbourThread>& threads_of(ComponentId c);
  /// False if a component has threads about at least two other axes in common with components of `body`: a panel on its
  /// screws does not turn about one of them. (A single one may be no thread.)
  bool may_turn(ComponentId c, const ThreadAxis& about, const ComponentSet& body);
  /// The moves that a sliding search tries: the component's directions, and the axes of its own surfaces of revolution
  /// and of those that it touches. The maximum effort is left at 0.
  /// @param body the components that are present
  SlideMoves slide_moves(ComponentId c, const ComponentSet& body, const DirectionChoice& choice,
                         const BlockingTable& table);

 private:
  const std::vector<RevolutionAxis>& revolution_axes_of(ComponentId c);
  const std::vector<ThreadAxis>& modelled_threads(ComponentId c);
  std::vector<ComponentId> neighbours_of(ComponentId c) const;

  PlannedAssembly planned_;
  MotionValidator& validator_;
  // Of each component, once computed.
  std::vector<std::optional<std::vector<NeighbourThread>>> threads_;
  std::vector<std::optional<std::vector<ThreadAxis>>> modelled_;
  std::vector<std::optional<std::vector<RevolutionAxis>>> revolution_axes_;
};

}  // namespace dismantle
