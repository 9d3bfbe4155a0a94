// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/engine/classify_pairs.h"
#include "tests/support/slide_scenes.h"

/// Motions of a simulated hand.
namespace dismantle::scenes {

/// A motion of the scene's component through `targets`, 0.01 s each.
inline Motion motion_of(const SlideScene& scene, const std::vector<Pose>& targets,
                        ResponseKind response = ResponseKind::Slide) {
  Motion motion;
  motion.response = response;
  motion.moves.push_back({{scene.assembly[scene.moving].name}, {}});
  for (const Pose& target : targets)
    motion.moves[0].targets.push_back({0.01 * static_cast<double>(motion.moves[0].targets.size() + 1), target});
  return motion;
}

/// The next `count` targets of a hand.
inline std::vector<Pose> pull(Hand hand, int count) {
  std::vector<Pose> targets;
  for (int k = 0; k < count; ++k) targets.push_back(hand.next());
  return targets;
}

/// The pair states for a tolerance and no other options. @pre the scene can be classified
inline PairStates states_of(const Assembly& assembly, double tolerance) {
  ClassifyOptions options;
  options.tolerance = tolerance;
  return classify_pairs(assembly, options).value();
}

}  // namespace dismantle::scenes
