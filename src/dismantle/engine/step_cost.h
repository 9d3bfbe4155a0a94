// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace dismantle {

/// The wall time of one stage of a step.
struct StageTime {
  std::string_view stage;  ///< A string literal; each method documents the names of its stages.
  double ms = 0;           ///< Summed over the sweeps of the step [ms].
};

/// The cost of one step of a MotionEngine. Members that do not apply to a method are 0.
struct StepCost {
  double ms = 0;                   ///< Wall time of the whole step [ms].
  std::size_t pairs = 0;           ///< Pairs of hierarchy nodes that the last sweep visited: the size of the front.
  std::size_t triangle_pairs = 0;  ///< Triangle pairs left by the broad phase (`streams`: of the last sweep).
  std::size_t tests = 0;           ///< Continuous tests of triangles or of their features, over all sweeps.
  std::size_t device_tests = 0;    ///< Those of `tests` that a device computed.
  std::size_t node_pairs = 0;      ///< Hierarchy node pairs that had no valid certificate, over all sweeps.
  std::size_t depth_tests = 0;  ///< Points and pieces of surfaces examined to bound the depth of pairs without ghosts.
  std::size_t overlapping_pairs = 0;  ///< Component pairs that are still embedded.
  std::size_t replays = 0;            ///< Stages repeated because a buffer was full.
  std::vector<StageTime> stages;      ///< In the order in which they run; empty for a method without stages.
};

}  // namespace dismantle
