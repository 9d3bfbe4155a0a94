// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan.h"
#include "dismantle/planner/search/motion_validator.h"

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace dismantle {

/// What came of the search for a way out that is not straight.
struct PathSearch {
  std::optional<PlanStep> step;
  std::vector<ComponentId> met;    ///< What was in the way somewhere: as long as all of it is there, nothing changes.
  std::optional<double> furthest;  ///< How far its center got, in its radii; nothing where it did not move at all.
  bool exhausted = false;          ///< All that there is to try was tried: more effort does not help.
};

/// Moves one component about with the engine, from where it was assembled, and remembers what it met. In the end all
/// stands as before.
class LocalPlanner {
 public:
  /// @param validator must outlive the local_planner, and nobody else may use it until then
  LocalPlanner(MotionValidator& validator, ComponentId component) : validator_(validator), component_(component), begun_(validator.effort()) {
    validator_.take(component);
  }
  ~LocalPlanner() { validator_.put_back(); }
  LocalPlanner(const LocalPlanner&) = delete;
  LocalPlanner& operator=(const LocalPlanner&) = delete;

  const Pose& pose() const { return validator_.pose(); }
  /// Goes on towards `target`, sliding along what is in the way.
  StepResult slide(const Pose& target);
  /// Whether it can go straight on from where it is by `way` [mm]; it stays where it is.
  bool exits(const Vec3& direction, double way);
  /// Those of `directions` (unit) that it may well go straight on in by `way` [mm]: a look, nothing moves.
  std::vector<Vec3> likely_exits(Span<const Vec3> directions, double way) {
    return validator_.likely_exits(directions, way);
  }
  /// Puts it back where it has been.
  void go_back(const Pose& pose) { validator_.go_back(pose); }
  /// What all that it did has cost: see MotionValidator::effort.
  std::size_t effort() const { return validator_.effort() - begun_; }
  std::vector<ComponentId> met() const { return {met_.begin(), met_.end()}; }

 private:
  MotionValidator& validator_;
  ComponentId component_;
  std::size_t begun_;
  std::set<ComponentId> met_;
};

}  // namespace dismantle
