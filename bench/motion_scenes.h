// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/result.h"
#include "dismantle/math/rigid_transform.h"

#include <string>
#include <vector>

namespace dismantle {

/// A moving set and its targets, one a step.
struct BenchMove {
  std::vector<ComponentId> components;  ///< Move as one rigid body.
  std::vector<Pose> targets;            ///< Of all of them, relative to the assembled state.
};

/// An assembly with a motion to measure.
struct BenchScene {
  std::string name;
  Assembly assembly;
  PairStates states;             ///< Of its pairs in the assembled state, with the tolerance.
  std::vector<BenchMove> moves;  ///< One after another.
};

/// Size of the scenes that are generated.
struct BenchSize {
  std::size_t triangles = 120'000;  ///< Roughly, of the whole assembly.
  int steps = 200;                  ///< Beyond the first target; `loose_in_lathe` has them too.
};

/// The names that make_bench_scenes knows.
std::vector<std::string> bench_scene_names();

/// Makes the scene of that name; for "samples", the four bundled assemblies with their bundled motions, each of which
/// has its own name too.
/// @param samples_folder with the STEP files and motions of the samples
/// Errors: those of reading; Usage for an unknown name.
Result<std::vector<BenchScene>> make_bench_scenes(const std::string& name, const BenchSize& size,
                                                  const std::string& samples_folder);

}  // namespace dismantle
