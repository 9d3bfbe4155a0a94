// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/progress.h"
#include "dismantle/planner/plan.h"

#include <cstddef>
#include <vector>

namespace dismantle {

/// What is preferred of several steps that can come next.
enum class StepPreference {
  Direction,  ///< It goes on in the direction of the step before.
  Upright,    ///< It does not lead downwards, so that nothing has to be turned over. z is up.
  Groups,     ///< What it takes is equal to what the step before took: fasteners of one kind together.
  Support,    ///< It leaves nothing that nothing holds from below any more, though something did.
};

/// What is asked of a planner.
struct PlanOptions {
  std::vector<ComponentId> targets;  ///< These shall come out, with as few others as possible; none: everything.
  std::vector<ComponentId> fixed;    ///< These never move. Without any, the largest component of each body stays.
  double time_limit = 0;             ///< [s]; 0: none.
  CertificateOptions engine;
  ProgressCallback progress;
  /// What all searches for sliding ways may cost together: see MotionValidator::effort; some 10 us each.
  std::size_t slide_effort = 400'000;
  /// The same for all searches for ways at random, which come after them.
  std::size_t sample_effort = 200'000;
  /// Of single components that can go straight out next: the first counts most. None: the first that are found, those
  /// in the direction of the step before first, which is faster.
  std::vector<StepPreference> preferences{};

  /// Lets these searches cost `times` as much. @pre not negative
  void search_longer(double times) {
    slide_effort = static_cast<std::size_t>(times * static_cast<double>(slide_effort));
    sample_effort = static_cast<std::size_t>(times * static_cast<double>(sample_effort));
  }
};

/// How the assembly comes apart. Every step's motion was tried with the engine: it holds the guarantee. Ends with what
/// was found so far where time is up or `progress` cancels.
Plan plan_disassembly(const Assembly& assembly, const PairStates& pairs, const PlanOptions& options);

/// Why a component does not come straight out of the assembled state; no blockers where it does.
Explanation why_blocked(const Assembly& assembly, const PairStates& pairs, ComponentId component,
                        const CertificateOptions& options);

}  // namespace dismantle
