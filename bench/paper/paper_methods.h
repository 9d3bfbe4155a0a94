// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/motion_scenes.h"
#include "dismantle/engine/motion_engine.h"
#include "dismantle/streams/sweep_engine.h"

#include <memory>
#include <string_view>
#include <vector>

namespace dismantle {

/// The methods that the evaluation compares.
enum class PaperMethod {
  FrontBased,         ///< Front-based multi-core detection, elementary tests: the baseline of the paper's figure 9.
  FrontBasedRigid,    ///< The same with FrontBasedWork::MovingComponents.
  StreamsElementary,  ///< The paper's method on the CPU with the paper's elementary tests.
  StreamsCertified,   ///< The same with certified tests: `--method streams` without its guard of vertices.
  StreamsCuda,        ///< The paper's method with the paper's tests on the CUDA device. @pre there is one
  Certificates,       ///< The default method.
  CertificatesCuda,   ///< The same with the CUDA device used in every sweep. @pre there is one
  ObbDiscrete,        ///< Trees of oriented boxes at discrete steps.
};

/// The name in tables.
std::string_view name_of(PaperMethod method);

/// Makes the engine of a method over a scene, on that many cores (the discrete test uses one). The scene must outlive
/// it.
std::unique_ptr<MotionEngine> make_method(PaperMethod method, const BenchScene& scene, int cores);

/// Wall time of a step in the columns of the paper's table 1 [ms].
struct TableTimes {
  double refit = 0;         ///< Vertices and hierarchy.
  double intersection = 0;  ///< Front and triangle tests.
  double overall = 0;       ///< The whole step, measured from outside.
};

/// Results of a method over a scene.
struct MethodRun {
  PaperMethod method = PaperMethod::FrontBased;
  int cores = 1;
  std::vector<TableTimes> times;     ///< Of each step but the first of each move; the shortest of the repeats.
  std::vector<StageTimings> stages;  ///< The same steps, stage by stage, of the shortest repeat.
  std::vector<Pose> poses;           ///< Of the moving set after each of these steps.
  std::size_t reached = 0;           ///< Number of these steps that reached their targets.
};

/// Plays the scene's motion with response Stop, `repeats` times from the assembled state.
MethodRun run_method(PaperMethod method, const BenchScene& scene, int cores, int repeats);

/// Mean over the steps [ms].
TableTimes mean_times(const MethodRun& run);
/// The q-th quantile of the overall time [ms]. @pre 0 <= q <= 1
double overall_quantile(const MethodRun& run, double q);

}  // namespace dismantle
