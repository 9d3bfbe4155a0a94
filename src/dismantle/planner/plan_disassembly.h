// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/flexible_part.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/progress.h"
#include "dismantle/planner/plan.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace dismantle {

/// A criterion for choosing the next step.
enum class StepPreference {
  Direction,  ///< It has the direction of the previous step.
  Upright,    ///< It does not move downwards, so that nothing has to be turned over. z is up.
  Groups,     ///< Its components equal those of the previous step: equal fasteners together.
  Support,    ///< It takes the support from below away from no component.
  Tools,      ///< It needs the tool of the previous one.
  Loose,      ///< It removes what is held no more.
};

/// The place of threaded fasteners in the order of steps.
enum class FastenerOrder {
  First,    ///< They come before what they hold (find_joints()), and leave along their axes, wherever that is possible.
  Ignored,  ///< As any other component.
};

/// Options of plan_disassembly.
struct PlanOptions {
  std::vector<ComponentId> targets;  ///< Components to remove, with as few others as possible; empty: everything.
  std::vector<ComponentId> fixed;    ///< Components that never move; empty: the largest component of each body.
  double time_limit = 0;             ///< [s]; 0: none.
  CertificateOptions engine;         ///< Options of the collision engine.
  ProgressCallback progress;         ///< May be empty; may cancel.
  /// Total effort of all searches for sliding paths: see MotionValidator::effort; about 10 us per unit.
  std::size_t slide_effort = 400'000;
  /// Total effort of all random searches, which come after them.
  std::size_t sample_effort = 200'000;
  /// Criteria for the order of the steps, the most important first; empty: the usual weights (OrderWeights). Direction
  /// and Upright also choose among the free directions of a component.
  std::vector<StepPreference> preferences{};
  /// The weight of each preference in the order of all steps (OrderWeights); empty: each counts ten times as much as
  /// the next.
  std::vector<double> preference_weights{};
  /// For each component that stays, an overlap is searched for by which it would come out, up to this much more than
  /// what is allowed (OverlapSearch) [mm]; 0: none.
  double overlap_limit = 0;
  /// Sets of components that are not taken apart (RigidGroups).
  std::vector<std::vector<ComponentId>> together{};
  /// Components that give; the pairs were declared accordingly (allow_flexible()). Rings and what they touch pass each
  /// other straight along their axes only.
  std::vector<FlexiblePart> flexible{};

  /// The place of threaded fasteners.
  FastenerOrder fasteners = FastenerOrder::First;
  /// Asked once the steps are found: false leaves out why components stay, which may take as long as the steps;
  /// Plan::staying then only names them. Empty: with reasons.
  std::function<bool(const Plan& steps)> wants_reasons{};

  /// Multiplies the effort of these searches. @pre times >= 0
  void search_longer(double times) {
    slide_effort = static_cast<std::size_t>(times * static_cast<double>(slide_effort));
    sample_effort = static_cast<std::size_t>(times * static_cast<double>(sample_effort));
  }
};

/// Finds a disassembly sequence. Every step's motion was validated by the engine and holds the guarantee. If the time
/// limit is reached or `progress` cancels, returns what was found so far.
Plan plan_disassembly(const Assembly& assembly, const PairStates& pairs, const PlanOptions& options);

/// Explains what blocks the straight removal of a component from the assembled state; no blockers if it can be removed.
/// @param options of which targets and fixed do not matter
Explanation why_blocked(const Assembly& assembly, const PairStates& pairs, ComponentId component,
                        const PlanOptions& options);

}  // namespace dismantle
