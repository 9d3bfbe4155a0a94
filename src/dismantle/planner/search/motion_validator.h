// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/keep_going.h"

#include <utility>
#include <vector>

namespace dismantle {

/// Tries the steps of a plan with the engine, which knows all rules of the guarantee.
class MotionValidator {
 public:
  /// @param far Distance [mm] at which what was taken away is out of everyone's way.
  /// @param keep_going once it says no, tries end as if blocked
  MotionValidator(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options, double far,
            KeepGoing keep_going);

  /// `present` stand in their assembled poses, all others are taken away.
  void stand(const ComponentSet& present);
  /// What came of a try.
  struct Trial {
    bool free = false;
    std::vector<std::pair<ComponentId, ComponentId>> against;  ///< Of the set, and what is in its way.
  };
  /// Whether the set comes out along a unit direction by `way` [mm]. All stands as before.
  Trial try_straight(Span<const ComponentId> set, const Vec3& direction, double way);
  /// What touches a component where it was assembled: the engine with it in hand.
  const CertificateEngine& hold(ComponentId component);
  const CertificateEngine& engine() const { return engine_; }
  /// What all motions have cost until now, in tests of two triangles: the same for the same input, whatever the clock.
  std::size_t effort() const { return effort_; }

  /// Takes one component in hand where it was assembled, to look for its way out.
  void take(ComponentId component);
  /// Where the one in hand is.
  const Pose& pose() const { return engine_.poses()[moving_.value]; }
  /// Goes on towards `target`, sliding along what is in the way.
  StepResult slide(const Pose& target) { return step(target, ResponseKind::Slide); }
  /// Puts what is in hand back where it has been.
  void go_back(const Pose& pose);
  /// Whether what is in hand can go straight on from where it is by `way` [mm]; it stays where it is.
  Trial try_exit(const Vec3& direction, double way);
  /// Those of `directions` (unit) that what is in hand may well go straight on in by `way` [mm]: a look, nothing moves.
  std::vector<Vec3> likely_exits(Span<const Vec3> directions, double way);
  /// All stands as before.
  void put_back();

 private:
  StepResult step(const Pose& target, ResponseKind response);
  /// From where the set in hand is.
  StepResult go_straight(const Vec3& direction, double way);
  StepResult go_part(const Pose& target, const Vec3& direction);
  Trial trial_of(const StepResult& made, Span<const ComponentId> set) const;
  bool some_parted() const { return engine_.embedded_pairs().size() != embedded_.size(); }

  const Assembly& assembly_;
  const PairStates& pairs_;
  CertificateOptions options_;
  double far_;
  KeepGoing keep_going_;
  CertificateEngine engine_;
  std::vector<Pose> poses_;
  ComponentId moving_;                     ///< One of the set in hand.
  std::vector<ComponentPair> embedded_;  ///< When it was taken in hand.
  std::size_t effort_ = 0;
};

}  // namespace dismantle
