// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/families/scene.h"
#include "dismantle/assembly/path.h"
#include "dismantle/engine/motion_engine.h"

namespace dismantle::families {

/// A random motion, and what the engine made of it.
struct Drive {
  Motion motion;                              ///< The targets, to be replayed.
  std::vector<Pose> poses;                    ///< The poses, from the assembled one on; each follows by one screw.
  std::vector<std::size_t> step_of;           ///< The target of each pose but the first.
  std::vector<Vec3> near_moving, near_fixed;  ///< Contacts [mm, assembled], for the oracle.
  int steps = 0;
  double slowest_ms = 0, seconds = 0;
};

/// Presses, slides, twists, draws back and throws the first component about.
Drive drive(const Scene& scene, MotionEngine& engine, Dice& dice, int max_steps, double max_seconds);
/// Moves the first component straight along a displacement in some steps.
Drive pull(const Scene& scene, MotionEngine& engine, Vec3 displacement, Dice& dice);

}  // namespace dismantle::families
