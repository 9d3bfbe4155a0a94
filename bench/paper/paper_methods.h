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
  StreamsElementary,  ///< The paper's method on the CPU with the paper's elementary tests and local locks.
  StreamsGlobalLock,  ///< The same with AppendLock::Global.
  StreamsCertified,   ///< The same with certified tests: `--method streams` without its guard of vertices.
  StreamsCuda,        ///< The paper's method with the paper's tests on the CUDA device. @pre there is one
  Certificates,       ///< The default method.
  CertificatesCuda,   ///< The same with the CUDA device used in every sweep. @pre there is one
  ObbDiscrete,        ///< Trees of oriented boxes at discrete steps.
  ObbBoxes,           ///< One oriented box a component at discrete steps.
};

/// The name in tables.
std::string_view name_of(PaperMethod method);
/// True if the method runs on a CUDA device.
bool needs_cuda(PaperMethod method);
/// True if the method runs on one core only.
bool is_serial(PaperMethod method);

/// Makes the engine of a method over a scene, on that many cores (the discrete tests use one). The scene must outlive
/// it.
std::unique_ptr<MotionEngine> make_method(PaperMethod method, const BenchScene& scene, int cores);

/// Extent of a run.
struct RunOptions {
  int cores = 1;
  int repeats = 1;               ///< Plays of the motion, each from the assembled state.
  std::size_t moves = SIZE_MAX;  ///< Only the first ones of the motion.
};

/// Results of a method over a scene.
struct MethodRun {
  PaperMethod method = PaperMethod::FrontBased;
  int cores = 1;
  /// Wall times of each step but the first of each move: `overall` is measured from outside, and of the repeats the one
  /// with the median `overall` counts (of two, the shorter).
  std::vector<StageTimings> times;
  std::vector<double> play_means;      ///< Mean `overall` of each repeat [ms].
  std::vector<std::uint8_t> embedded;  ///< 1: in this step the moving set moves against a pair of S_i.
  std::vector<Pose> poses;             ///< Of the moving set after each of these steps.
  std::size_t reached = 0;             ///< Number of these steps that reached their targets.
};

/// Plays the scene's motion with response Stop, `repeats` times from the assembled state.
MethodRun run_method(PaperMethod method, const BenchScene& scene, const RunOptions& options);

/// Mean over the steps [ms].
StageTimings mean_times(const MethodRun& run);
/// The overall times [ms].
std::vector<double> overall_times(const MethodRun& run);

}  // namespace dismantle
