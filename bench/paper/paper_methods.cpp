// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/paper_methods.h"

#include "bench/baselines/front_based_engine.h"
#include "bench/baselines/obb_discrete_engine.h"
#include "bench/timing.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/streams/stage_clock.h"
#include "dismantle/streams/streams_backend.h"
#include "dismantle/streams/streams_motion_engine.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// The stages of a step; a method without stages has one intersection test.
StageTimings stages_of(const StepCost& cost, double overall) {
  StageTimings t;
  t.overall = overall;
  if (cost.stages.empty()) t.intersection = overall;
  for (const StageTime& time : cost.stages) {
    if (time.stage == kVerticesStage) t.vertices = time.ms;
    if (time.stage == kRefitStage) t.refit = time.ms;
    if (time.stage == kFrontStage) t.front = time.ms;
    if (time.stage == kIntersectionStage) t.intersection = time.ms;
  }
  return t;
}

/// True if a component of the moving set is in a free pair with one that does not move.
bool moves_embedded(const MotionEngine& engine) {
  const Span<const ComponentId> moving = engine.moving_set();
  const auto moves = [&](ComponentId c) { return std::find(moving.begin(), moving.end(), c) != moving.end(); };
  const std::vector<ComponentPair> pairs = engine.overlapping_pairs();
  return std::any_of(pairs.begin(), pairs.end(), [&](const ComponentPair& pair) {
    return pair.state == PairState::Free && moves(pair.a) != moves(pair.b);
  });
}

/// Plays the scene once. @return the times of each step; the other results go into `run` at the first play
std::vector<StageTimings> play(const BenchScene& scene, MotionEngine& engine, std::size_t moves, MethodRun& run) {
  const bool first_play = run.play_means.empty();
  std::vector<StageTimings> times;
  for (std::size_t m = 0; m < std::min(moves, scene.moves.size()); ++m) {
    const BenchMove& move = scene.moves[m];
    engine.grab(move.components);
    for (std::size_t k = 0; k < move.targets.size(); ++k) {
      const bool embedded = first_play && moves_embedded(engine);
      StageClock clock;
      const StepResult result = engine.step(move.targets[k], ResponseKind::Stop);
      const double overall = clock.total();
      if (k == 0) continue;  // builds the front
      times.push_back(stages_of(result.cost, overall));
      if (!first_play) continue;
      run.poses.push_back(result.pose);
      run.embedded.push_back(embedded ? 1 : 0);
      run.reached += result.reached ? 1 : 0;
    }
  }
  double sum = 0;
  for (const StageTimings& t : times) sum += t.overall;
  run.play_means.push_back(sum / static_cast<double>(std::max<std::size_t>(1, times.size())));
  return times;
}

std::unique_ptr<MotionEngine> sweeping(const BenchScene& scene, std::unique_ptr<SweepEngine> engine) {
  return make_sweeping_motion_engine(scene.assembly, scene.states.tolerance, std::move(engine));
}

}  // namespace

std::string_view name_of(PaperMethod method) {
  switch (method) {
    case PaperMethod::FrontBased:
      return "front-based";
    case PaperMethod::FrontBasedRigid:
      return "front-based (rigid)";
    case PaperMethod::StreamsElementary:
    case PaperMethod::StreamsCuda:
      return "streams (elementary)";
    case PaperMethod::StreamsGlobalLock:
      return "streams (global lock)";
    case PaperMethod::StreamsCertified:
      return "streams (certified)";
    case PaperMethod::Certificates:
    case PaperMethod::CertificatesCuda:
      return "certificates";
    case PaperMethod::ObbDiscrete:
      return "boxes (discrete)";
    case PaperMethod::ObbBoxes:
      return "one box a component (discrete)";
  }
  return "";
}

bool needs_cuda(PaperMethod method) {
  return method == PaperMethod::StreamsCuda || method == PaperMethod::CertificatesCuda;
}

bool is_serial(PaperMethod method) {
  return method == PaperMethod::ObbDiscrete || method == PaperMethod::ObbBoxes;
}

std::unique_ptr<MotionEngine> make_method(PaperMethod method, const BenchScene& scene, int cores) {
  const Executor executor = cores > 1 ? Executor(ExecutorKind::Threads, cores) : Executor();
  const CertificateOptions certificates{executor, widest_lanes()};
  CollisionOptions options;
  options.executor = executor;
  options.test = method == PaperMethod::StreamsCertified ? ElementaryTest::Certified : ElementaryTest::Elementary;
  if (method == PaperMethod::StreamsGlobalLock) options.append_lock = AppendLock::Global;
  const FrontBasedWork work =
      method == PaperMethod::FrontBased ? FrontBasedWork::AllComponents : FrontBasedWork::MovingComponents;
  switch (method) {
    case PaperMethod::FrontBased:
    case PaperMethod::FrontBasedRigid:
      return sweeping(scene, make_front_based_engine(scene.assembly, scene.states, options, work));
    case PaperMethod::StreamsElementary:
    case PaperMethod::StreamsGlobalLock:
    case PaperMethod::StreamsCertified:
      return sweeping(scene, make_streams_engine(scene.assembly, scene.states, options));
    case PaperMethod::StreamsCuda:
      return sweeping(scene, make_streams_engine(scene.assembly, scene.states, options,
                                                 make_cuda_streams_backend(scene.assembly, options).value()));
    case PaperMethod::Certificates:
      return std::make_unique<CertificateEngine>(scene.assembly, scene.states, certificates);
    case PaperMethod::CertificatesCuda:
      return std::make_unique<CertificateEngine>(scene.assembly, scene.states, certificates,
                                                 CertificateDevice{std::move(make_cuda_front_device().value()), 0});
    case PaperMethod::ObbDiscrete:
    case PaperMethod::ObbBoxes:
      break;
  }
  return make_obb_discrete_engine(scene.assembly, scene.states,
                                  method == PaperMethod::ObbBoxes ? ObbDetail::Boxes : ObbDetail::Triangles);
}

MethodRun run_method(PaperMethod method, const BenchScene& scene, const RunOptions& options) {
  MethodRun run;
  run.method = method;
  run.cores = is_serial(method) ? 1 : options.cores;
  // Free pairs that have been apart do not become free again.
  const bool keeps_engine = std::none_of(scene.states.pairs.begin(), scene.states.pairs.end(),
                                         [](const ComponentPair& pair) { return pair.state == PairState::Free; });
  std::unique_ptr<MotionEngine> engine;
  std::vector<std::vector<StageTimings>> plays;
  for (int i = 0; i < options.repeats; ++i) {
    if (!engine || !keeps_engine) engine = make_method(method, scene, options.cores);
    engine->jump(std::vector<Pose>(scene.assembly.components.size()));
    plays.push_back(play(scene, *engine, options.moves, run));
  }
  for (std::size_t step = 0; step < plays.front().size(); ++step) {
    std::vector<StageTimings> of_step;
    for (const std::vector<StageTimings>& play : plays) of_step.push_back(play[step]);
    const auto median = of_step.begin() + static_cast<std::ptrdiff_t>((of_step.size() - 1) / 2);
    std::nth_element(of_step.begin(), median, of_step.end(),
                     [](const StageTimings& a, const StageTimings& b) { return a.overall < b.overall; });
    run.times.push_back(*median);
  }
  return run;
}

StageTimings mean_times(const MethodRun& run) {
  StageTimings sum;
  const double share = 1 / static_cast<double>(std::max<std::size_t>(1, run.times.size()));
  for (const StageTimings& t : run.times) {
    sum.vertices += share * t.vertices;
    sum.refit += share * t.refit;
    sum.front += share * t.front;
    sum.intersection += share * t.intersection;
    sum.overall += share * t.overall;
  }
  return sum;
}

std::vector<double> overall_times(const MethodRun& run) {
  std::vector<double> ms;
  for (const StageTimings& times : run.times) ms.push_back(times.overall);
  return ms;
}

}  // namespace dismantle
