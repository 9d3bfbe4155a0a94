// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan.h"
#include "dismantle/planner/search/step_maker.h"

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace dismantle {

/// What came of the search for a way out that is not straight.
struct WaySearch {
  std::optional<PlanStep> step;
  std::vector<ComponentId> met;    ///< What was in the way somewhere: as long as all of it is there, nothing changes.
  std::optional<double> furthest;  ///< How far its center got, in its radii; nothing where it did not move at all.
  bool exhausted = false;          ///< All that there is to try was tried: more effort does not help.
};

/// Moves one component about with the engine, from where it was assembled, and remembers what it met. In the end all
/// stands as before.
class Explorer {
 public:
  /// @param maker must outlive the explorer, and nobody else may use it until then
  Explorer(StepMaker& maker, ComponentId component) : maker_(maker), component_(component), begun_(maker.effort()) {
    maker_.take(component);
  }
  ~Explorer() { maker_.put_back(); }
  Explorer(const Explorer&) = delete;
  Explorer& operator=(const Explorer&) = delete;

  const Pose& pose() const { return maker_.pose(); }
  /// Goes on towards `target`, sliding along what is in the way.
  StepResult slide(const Pose& target);
  /// Whether it can go straight on from where it is by `way` [mm]; it stays where it is.
  bool exits(const Vec3& direction, double way);
  /// Those of `directions` (unit) that it may well go straight on in by `way` [mm]: a look, nothing moves.
  std::vector<Vec3> likely_exits(Span<const Vec3> directions, double way) {
    return maker_.likely_exits(directions, way);
  }
  /// Puts it back where it has been.
  void go_back(const Pose& pose) { maker_.go_back(pose); }
  /// What all that it did has cost: see StepMaker::effort.
  std::size_t effort() const { return maker_.effort() - begun_; }
  std::vector<ComponentId> met() const { return {met_.begin(), met_.end()}; }

 private:
  StepMaker& maker_;
  ComponentId component_;
  std::size_t begun_;
  std::set<ComponentId> met_;
};

}  // namespace dismantle
