// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/rigid_groups.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/keep_going.h"
#include "dismantle/planner/component_set.h"

#include <utility>
#include <vector>

namespace dismantle {

/// Validates motions of a plan with the collision engine, which applies all rules of the guarantee.
class MotionValidator {
 public:
  /// @param groups of components that move together; must outlive this @param far Distance at which removed components
  /// are parked [mm].
  /// @param keep_going once it returns false, motions end as if blocked
  MotionValidator(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options,
                  const RigidGroups& groups, double far, KeepGoing keep_going);

  /// Puts `present` into their assembled poses and removes all others.
  void stand(const ComponentSet& present);
  /// The result of a trial motion.
  struct Trial {
    bool free = false;                                         ///< The whole motion is free.
    std::vector<std::pair<ComponentId, ComponentId>> against;  ///< Pairs that block: one of the set, and the other.
  };
  /// Tests whether the set can move along a unit direction by `way` [mm]. The state is restored.
  Trial try_straight(Span<const ComponentId> set, const Vec3& direction, double way);
  /// The distance from a set at a pose to all others that are present, if it is below `limit` [mm]: engine's
  /// clearance().
  Clearance clearance_at(Span<const ComponentId> set, const Pose& pose, double limit);
  /// The engine with one component as the moving set in its assembled pose, for queries.
  const CertificateEngine& hold(ComponentId component);
  /// The engine.
  const CertificateEngine& engine() const { return engine_; }
  /// The cost of all motions so far, in triangle-pair tests: a deterministic measure of time.
  std::size_t effort() const { return effort_; }

  /// Makes the group of a component the moving set in its assembled pose, to search for its exit path.
  void take(ComponentId component);
  /// True if a component is in the group that was taken.
  bool moves(ComponentId c) const { return groups_.together(moving_, c); }
  /// The present pose of the moving set.
  const Pose& pose() const { return engine_.poses()[moving_.value]; }
  /// Moves towards `target`, sliding along contacts.
  StepResult slide(const Pose& target) { return step(target, ResponseKind::Slide); }
  /// Returns the moving set to a pose reached before.
  void go_back(const Pose& pose);
  /// Tests whether the moving set can move straight on by `way` [mm]; it keeps its pose.
  Trial try_exit(const Vec3& direction, double way);
  /// The unit `directions` along which the moving set can probably move straight on by `way` [mm]. Nothing moves.
  std::vector<Vec3> likely_exits(Span<const Vec3> directions, double way);
  /// Restores the assembled pose.
  void put_back();

 private:
  StepResult step(const Pose& target, ResponseKind response);
  /// From the present pose.
  StepResult go_straight(const Vec3& direction, double way);
  StepResult go_part(const Pose& target, const Vec3& direction);
  static Trial trial_of(const StepResult& made, Span<const ComponentId> set);

  double tolerance_;
  const RigidGroups& groups_;
  double far_;
  KeepGoing keep_going_;
  CertificateEngine engine_;
  std::vector<Pose> poses_;
  ComponentId moving_;  ///< One of the moving set.
  std::size_t effort_ = 0;
};

}  // namespace dismantle
