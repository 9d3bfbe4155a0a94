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

/// The stages of a step in the columns of the page; a method without stages has one intersection test.
StageTimings stages_of(const StepCost& cost) {
  StageTimings t;
  t.overall = cost.ms;
  if (cost.stages.empty()) t.intersection = cost.ms;
  for (const StageTime& time : cost.stages) {
    if (time.stage == kVerticesStage) t.vertices = time.ms;
    if (time.stage == kRefitStage) t.refit = time.ms;
    if (time.stage == kFrontStage) t.front = time.ms;
    if (time.stage == kIntersectionStage) t.intersection = time.ms;
  }
  return t;
}

/// Plays the scene once and keeps the shorter time of each step.
void play(const BenchScene& scene, MotionEngine& engine, MethodRun& run) {
  std::size_t index = 0;
  for (const BenchMove& move : scene.moves) {
    engine.grab(move.components);
    for (std::size_t k = 0; k < move.targets.size(); ++k) {
      StageClock clock;
      const StepResult result = engine.step(move.targets[k], ResponseKind::Stop);
      const double overall = clock.total();
      if (k == 0) continue;  // builds the front
      const StageTimings t = stages_of(result.cost);
      const TableTimes times{t.vertices + t.refit, t.front + t.intersection, overall};
      if (index == run.times.size()) {
        run.times.push_back(times);
        run.stages.push_back(t);
        run.poses.push_back(result.pose);
        run.reached += result.reached ? 1 : 0;
      } else if (overall < run.times[index].overall) {
        run.times[index] = times;
        run.stages[index] = t;
      }
      ++index;
    }
  }
}

}  // namespace

std::string_view name_of(PaperMethod method) {
  switch (method) {
    case PaperMethod::FrontBased:
      return "front-based";
    case PaperMethod::FrontBasedRigid:
      return "front-based (rigid)";
    case PaperMethod::StreamsElementary:
      return "streams (elementary)";
    case PaperMethod::StreamsCertified:
      return "streams (certified)";
    case PaperMethod::StreamsCuda:
      return "streams (elementary, CUDA)";
    case PaperMethod::Certificates:
      return "certificates";
    case PaperMethod::CertificatesCuda:
      return "certificates (CUDA)";
    case PaperMethod::ObbDiscrete:
      return "boxes (discrete)";
  }
  return "";
}

std::unique_ptr<MotionEngine> make_method(PaperMethod method, const BenchScene& scene, int cores) {
  const Executor executor = cores > 1 ? Executor(ExecutorKind::Threads, cores) : Executor();
  CollisionOptions options;
  options.executor = executor;
  options.test = method == PaperMethod::StreamsCertified ? ElementaryTest::Certified : ElementaryTest::Elementary;
  const FrontBasedWork work =
      method == PaperMethod::FrontBased ? FrontBasedWork::AllComponents : FrontBasedWork::MovingComponents;
  switch (method) {
    case PaperMethod::FrontBased:
    case PaperMethod::FrontBasedRigid:
      return make_sweeping_motion_engine(scene.assembly, scene.states.tolerance,
                                         make_front_based_engine(scene.assembly, scene.states, options, work));
    case PaperMethod::StreamsElementary:
    case PaperMethod::StreamsCertified:
      return make_sweeping_motion_engine(scene.assembly, scene.states.tolerance,
                                         make_streams_engine(scene.assembly, scene.states, options));
    case PaperMethod::StreamsCuda:
      return make_sweeping_motion_engine(
          scene.assembly, scene.states.tolerance,
          make_streams_engine(scene.assembly, scene.states, options,
                              make_cuda_streams_backend(scene.assembly, options).value()));
    case PaperMethod::Certificates:
      return std::make_unique<CertificateEngine>(scene.assembly, scene.states,
                                                 CertificateOptions{executor, widest_lanes()});
    case PaperMethod::CertificatesCuda:
      return std::make_unique<CertificateEngine>(scene.assembly, scene.states,
                                                 CertificateOptions{executor, widest_lanes()},
                                                 CertificateDevice{std::move(make_cuda_front_device().value()), 0});
    case PaperMethod::ObbDiscrete:
      break;
  }
  return make_obb_discrete_engine(scene.assembly, scene.states, ObbDetail::Triangles);
}

MethodRun run_method(PaperMethod method, const BenchScene& scene, int cores, int repeats) {
  MethodRun run;
  run.method = method;
  run.cores = cores;
  for (int i = 0; i < repeats; ++i) play(scene, *make_method(method, scene, cores), run);
  return run;
}

TableTimes mean_times(const MethodRun& run) {
  TableTimes sum;
  for (const TableTimes& c : run.times) {
    sum.refit += c.refit;
    sum.intersection += c.intersection;
    sum.overall += c.overall;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, run.times.size()));
  return {sum.refit / count, sum.intersection / count, sum.overall / count};
}

double overall_quantile(const MethodRun& run, double q) {
  std::vector<double> ms;
  for (const TableTimes& times : run.times) ms.push_back(times.overall);
  return bench::quantile(std::move(ms), q);
}

}  // namespace dismantle
