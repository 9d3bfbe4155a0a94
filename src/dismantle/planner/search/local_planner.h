// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan.h"
#include "dismantle/planner/search/motion_validator.h"

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace dismantle {

/// The result of a search for an exit path that is not straight.
struct PathSearch {
  std::optional<PlanStep> step;    ///< The path found, if any.
  std::vector<ComponentId> met;    ///< Components that were met: the result stays valid while all of them are present.
  std::optional<double> furthest;  ///< Largest displacement of its center, in its radii; none if it could not move.
  bool exhausted = false;          ///< The search space is exhausted: more effort does not help.
};

/// The local planner of the searches: moves one component, with its group, from its assembled pose with the engine, and
/// records what it meets. Its destructor restores the state.
class LocalPlanner {
 public:
  /// @param validator must outlive the local_planner, and must not be used elsewhere until then
  LocalPlanner(MotionValidator& validator, ComponentId component) : validator_(validator), begun_(validator.effort()) {
    validator_.take(component);
  }
  ~LocalPlanner() { validator_.put_back(); }
  LocalPlanner(const LocalPlanner&) = delete;
  LocalPlanner& operator=(const LocalPlanner&) = delete;

  /// The present pose.
  const Pose& pose() const { return validator_.pose(); }
  /// Moves towards `target`, sliding along contacts.
  StepResult slide(const Pose& target);
  /// True if it can move straight on by `way` [mm] from the present pose, which is kept.
  bool exits(const Vec3& direction, double way);
  /// The unit `directions` along which it can probably move straight on by `way` [mm]. Nothing moves.
  std::vector<Vec3> likely_exits(Span<const Vec3> directions, double way) {
    return validator_.likely_exits(directions, way);
  }
  /// Returns to a pose reached before.
  void go_back(const Pose& pose) { validator_.go_back(pose); }
  /// Effort spent so far: see MotionValidator::effort.
  std::size_t effort() const { return validator_.effort() - begun_; }
  /// The components met so far, ascending.
  std::vector<ComponentId> met() const { return {met_.begin(), met_.end()}; }

 private:
  MotionValidator& validator_;
  std::size_t begun_;
  std::set<ComponentId> met_;
};

}  // namespace dismantle
