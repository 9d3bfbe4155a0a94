// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/result.h"
#include "dismantle/math/rigid_transform.h"

#include <string>
#include <vector>

namespace dismantle {

/// Components that are taken in hand, and where the hand wants them step by step.
struct BenchMove {
  std::vector<ComponentId> components;
  std::vector<Pose> targets;
};

/// What is measured: an assembly, how its pairs stand, and a motion.
struct BenchScene {
  std::string name;
  Assembly assembly;
  PairStates states;
  std::vector<BenchMove> moves;
};

/// How large and how long.
struct BenchSize {
  std::size_t triangles = 120'000;  ///< Of generated scenes.
  int steps = 200;                  ///< Of generated scenes, and of the loose component.
};

/// The names that make_bench_scenes knows, in the order of the table.
std::vector<std::string> bench_scene_names();

/// The scenes of that name: one; for "samples", the four bundled assemblies with their bundled motions, which can also
/// be had each by its name. Files are read from `samples_folder`. Errors: those of reading; Usage for an unknown name.
Result<std::vector<BenchScene>> make_bench_scenes(const std::string& name, const BenchSize& size,
                                                  const std::string& samples_folder);

}  // namespace dismantle
