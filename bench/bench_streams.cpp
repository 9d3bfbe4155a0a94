// SPDX-License-Identifier: Apache-2.0
// Time of a step of the method `streams`, stage by stage. Scene: a shaft slides and wobbles in its hole, 0.1 mm a step.
//   bench_streams [--device cpu|cuda] [--threads N] [--clearance MM] [--steps N] [--ccd certified|elementary]
//                 [TRIANGLES...]
// One row a size, tab-separated: means of the stages, then mean, median, p99 and longest of the whole step; wall time.
// The first step, which builds the front, is left out. --threads 0 runs without an executor.
#include "bench/command_line.h"
#include "bench/timing.h"
#include "dismantle/streams/choose_streams_backend.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace dismantle {
namespace {

struct Settings {
  DeviceChoice device = DeviceChoice::Cpu;
  int threads = 2;
  double clearance = 0.1;  // between shaft and hole, radial [mm]; below 0 they overlap and are a fit
  int steps = 100;
  ElementaryTest test = ElementaryTest::Certified;
  std::vector<std::size_t> triangles = {3000, 10'000, 120'000, 1'000'000};
};

/// A housing with a hole of radius 10 and a shaft in it, 100 long, of about `triangles` triangles that are as long as
/// wide.
Assembly shaft_in_hole(std::size_t triangles, double clearance) {
  // The housing has four walls' worth of 2 * sides * rings / 2 triangles, the shaft one: 6 * sides * rings in all.
  const double circumference_over_length = 2 * std::acos(-1.0) * 10 / 100;
  const double sides = std::sqrt(static_cast<double>(triangles) / 6 * circumference_over_length);
  const auto side_count = static_cast<std::uint32_t>(std::lround(std::max(8.0, sides)));
  const auto ring_count =
      static_cast<std::uint32_t>(std::lround(std::max(1.0, static_cast<double>(triangles) / 6 / side_count)));
  return scenes::assembly(
      {scenes::component("housing", scenes::tube(20, 10, 0, 100, side_count, ring_count)),
       scenes::component("shaft", scenes::tube(10 - clearance, 0, 0, 100, side_count, ring_count))});
}

PairStates states_for(const Settings& settings) {
  PairStates states;
  states.tolerance = 0.01;
  if (settings.clearance <= 0) {
    ComponentPair pair;
    pair.a = ComponentId(0);
    pair.b = ComponentId(1);
    pair.state = PairState::Contact;
    pair.allowed_depth = states.tolerance - 2 * settings.clearance;
    states.pairs.push_back(pair);
  }
  return states;
}

/// The pose at a step: forward by 0.1 mm, to and fro across by a tenth of the clearance.
RigidTransform pose_at(int step, double clearance) {
  const double across = 0.1 * std::abs(clearance) * ((step * 7) % 5 - 2) / 2;
  const Pose pose{{across, 0.5 * across, 0.1 * step}, quat_about({0, 0, 1}, 1e-4 * ((step * 3) % 5 - 2))};
  return transform_from_pose(pose);
}

void run(const Settings& settings, std::size_t triangles) {
  const Assembly assembly = shaft_in_hole(triangles, settings.clearance);
  const Executor executor = settings.threads > 0 ? Executor(ExecutorKind::Threads, settings.threads) : Executor();
  const bench::Stopwatch building;
  const CollisionOptions options{settings.test, executor, 1 << 16};
  ChosenStreamsBackend chosen = choose_streams_backend(assembly, options, settings.device);
  if (!chosen.why.empty()) std::fprintf(stderr, "bench_streams: on the CPU (%s)\n", chosen.why.c_str());
  const std::unique_ptr<SweepEngine> engine =
      make_streams_engine(assembly, states_for(settings), options, std::move(chosen.backend));
  const double build_ms = building.ms();

  StageTimings sum;
  std::vector<double> overall;
  SweepResult last;
  int blocked = 0;
  std::vector<RigidTransform> next(2);
  for (int step = 0; step <= settings.steps; ++step) {
    next[1] = pose_at(step, settings.clearance);
    last = engine->sweep(next, 1e-4);
    if (last.free) engine->commit();
    blocked += last.free ? 0 : 1;
    if (step == 0) continue;  // the first step builds the front
    sum.vertices += last.timings.vertices;
    sum.refit += last.timings.refit;
    sum.front += last.timings.front;
    sum.intersection += last.timings.intersection;
    overall.push_back(last.timings.overall);
  }
  const auto mean = [&](double ms) { return ms / settings.steps; };
  std::printf("%zu\t%.0f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%zu\t%zu\t%zu\t%d\n",
              triangle_count(assembly), build_ms, mean(sum.vertices), mean(sum.refit), mean(sum.front),
              mean(sum.intersection), bench::mean(overall), bench::quantile(overall, 0.5),
              bench::quantile(overall, 0.99), bench::quantile(overall, 1), last.sizes.front, last.sizes.triangle_pairs,
              last.sizes.elementary_tests, blocked);
  std::fflush(stdout);
}

bool parse(int argc, char** argv, Settings& settings) {
  bench::CommandLine line(
      "bench_streams [--device cpu|cuda] [--threads N] [--clearance MM] [--steps N]\n"
      "                     [--ccd certified|elementary] [TRIANGLES...]");
  line.choice("--device", settings.device, {{"cpu", DeviceChoice::Cpu}, {"cuda", DeviceChoice::Cuda}});
  line.option("--threads", settings.threads, 0);
  line.option("--clearance", settings.clearance);
  line.option("--steps", settings.steps, 1);
  line.choice("--ccd", settings.test,
              {{"certified", ElementaryTest::Certified}, {"elementary", ElementaryTest::Elementary}});
  line.numbers(settings.triangles);
  return line.parse(argc, argv);
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  dismantle::Settings settings;
  if (!dismantle::parse(argc, argv, settings)) return dismantle::bench::kExitUsage;
  std::printf(
      "triangles\tbuild_ms\tvertices_ms\trefit_ms\tfront_ms\tintersection_ms\tmean_ms\tmedian_ms\tp99_ms\tmax_"
      "ms\tfront\t"
      "triangle_pairs\telementary_tests\tblocked_steps\n");
  for (const std::size_t triangles : settings.triangles) dismantle::run(settings, triangles);
  return 0;
}
