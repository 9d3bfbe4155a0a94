// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/engine/motion_engine.h"

#include <vector>

namespace dismantle {

/// One simulation step of a motion, with its result and cost.
struct PlayedStep {
  std::size_t move = 0;    ///< Index into Motion::moves.
  std::size_t target = 0;  ///< Index into MotionMove::targets.
  double time = 0;         ///< [s]
  StepResult result;       ///< Pose reached, contacts and cost.
};

/// The result of playing a motion.
struct PlayedMotion {
  Path path;  ///< The path that the components really took; one frame for each screw, at least one for each target.
  std::vector<PlayedStep> steps;  ///< One for each target.
  bool cancelled = false;         ///< `progress` ended it early; `path` is what was moved until then.
};

/// Plays a motion with collision handling: one step for each target, from the pose really reached to the next
/// target.
/// @param engine in its start state: every component assembled
/// Errors: Usage if the motion names an unknown component, or moves components together whose poses differ.
/// @pre engine.can_respond(motion.response)
Result<PlayedMotion> play_motion(const Assembly& assembly, const PairStates& pairs, const Motion& motion,
                                 MotionEngine& engine, const ProgressCallback& progress = {});

}  // namespace dismantle
