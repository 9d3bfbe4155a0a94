// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/engine/motion_engine.h"

#include <vector>

namespace dismantle {

/// One simulation step of a motion: what it asked for, what came of it, and what it cost.
struct PlayedStep {
  std::size_t move = 0;    ///< Index into Motion::moves.
  std::size_t target = 0;  ///< Index into MotionMove::targets.
  double time = 0;         ///< [s]
  StepResult result;
};

/// What playing a motion gave.
struct PlayedMotion {
  Path path;  ///< How far the components really got; one frame a screw, at least one a target.
  std::vector<PlayedStep> steps;
  bool cancelled = false;  ///< `progress` ended it early; path holds what was moved until then.
};

/// Plays a motion with collision handling: one step a target, each from the pose really reached to the next target.
/// @param engine in its start state: every component assembled
/// Errors: Usage where the motion names an unknown component, or moves components together whose poses differ by then.
/// @pre engine.can_respond(motion.response)
Result<PlayedMotion> play_motion(const Assembly& assembly, const PairStates& pairs, const Motion& motion,
                                 MotionEngine& engine, const ProgressCallback& progress = {});

}  // namespace dismantle
