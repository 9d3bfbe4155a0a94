// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/motion_scenes.h"
#include "dismantle/engine/motion_engine.h"

#include <memory>
#include <string_view>
#include <vector>

namespace dismantle {

/// The methods that the evaluation compares.
enum class PaperMethod {
  FrontBased,         ///< Front-based multi-core detection, elementary tests: the baseline of the paper's figure 9.
  FrontBasedRigid,    ///< The same, told what moves: FrontBasedWork::MovingComponents.
  StreamsElementary,  ///< The paper's method on the CPU with the paper's elementary tests.
  StreamsCertified,   ///< The same with certified tests: what `--method streams` does, without its guard of vertices.
  StreamsCuda,        ///< The paper's method with the paper's tests on the CUDA device. @pre there is one
  Certificates,       ///< Our own method, as it is.
  CertificatesCuda,   ///< The same, asking the CUDA device in every sweep. @pre there is one
  ObbDiscrete,        ///< Trees of oriented boxes at discrete steps.
};

/// As tables have it.
std::string_view name_of(PaperMethod method);

/// The method over a scene, on that many cores (the discrete test uses one). The scene must outlive it.
std::unique_ptr<MotionEngine> make_method(PaperMethod method, const BenchScene& scene, int cores);

/// Wall time of a step [ms], in the columns of the paper's table 1.
struct StepCost {
  double refit = 0;         ///< Vertices and hierarchy.
  double intersection = 0;  ///< Front and triangle tests.
  double overall = 0;       ///< Everything, measured from outside.
};

/// What a method made of a scene.
struct MethodRun {
  PaperMethod method = PaperMethod::FrontBased;
  int cores = 1;
  std::vector<StepCost> costs;      ///< Of each step, but for the first of each move; the least of the repeats.
  std::vector<StepTimings> stages;  ///< The same steps, stage by stage, of the repeat that took least.
  std::vector<Pose> poses;          ///< Where the set in hand was after each of these steps.
  std::size_t reached = 0;          ///< How many of them reached their targets.
};

/// Plays the scene's motion with response Stop, `repeats` times from the assembled state.
MethodRun run_method(PaperMethod method, const BenchScene& scene, int cores, int repeats);

/// Mean over the steps [ms].
StepCost mean_cost(const MethodRun& run);
/// The q-th quantile of the overall time [ms]. @pre 0 <= q <= 1
double overall_quantile(const MethodRun& run, double q);

}  // namespace dismantle
