// SPDX-License-Identifier: Apache-2.0
// Time a step of the streams method, stage by stage: a shaft slides and wobbles in its hole, 0.1 mm a step.
//   bench_streams [--device cpu|cuda] [--threads N] [--clearance MM] [--steps N] [--ccd certified|elementary]
//                 [TRIANGLES...]
#include "dismantle/collision/choose_streams_backend.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
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
  std::vector<std::size_t> triangles;
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
    pair.state = PairState::Fit;
    pair.allowed_penetration = states.tolerance - 2 * settings.clearance;
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
  const auto start = std::chrono::steady_clock::now();
  const CollisionOptions options{settings.test, executor, 1 << 16};
  ChosenStreamsBackend chosen = choose_streams_backend(assembly, options, settings.device);
  if (!chosen.why.empty()) std::fprintf(stderr, "bench_streams: on the CPU (%s)\n", chosen.why.c_str());
  const std::unique_ptr<CollisionEngine> engine =
      make_streams_engine(assembly, states_for(settings), options, std::move(chosen.backend));
  const std::chrono::duration<double, std::milli> built = std::chrono::steady_clock::now() - start;

  StepTimings sum;
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
  std::sort(overall.begin(), overall.end());
  double total = 0;
  for (const double ms : overall) total += ms;
  const auto mean = [&](double ms) { return ms / settings.steps; };
  std::printf("%zu\t%.0f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%zu\t%zu\t%zu\t%d\n", triangle_count(assembly),
              built.count(), mean(sum.vertices), mean(sum.refit), mean(sum.front), mean(sum.intersection), mean(total),
              overall[overall.size() / 2], overall[overall.size() * 99 / 100], last.sizes.front,
              last.sizes.triangle_pairs, last.sizes.elementary_tests, blocked);
  std::fflush(stdout);
}

bool parse(int argc, char** argv, Settings& settings) {
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option.rfind("--", 0) != 0) {
      settings.triangles.push_back(std::strtoull(argv[i], nullptr, 10));
      continue;
    }
    if (++i == argc) return false;
    if (option == "--device") {
      settings.device = std::strcmp(argv[i], "cuda") == 0 ? DeviceChoice::Cuda : DeviceChoice::Cpu;
    } else if (option == "--threads") {
      settings.threads = std::atoi(argv[i]);
    } else if (option == "--clearance") {
      settings.clearance = std::atof(argv[i]);
    } else if (option == "--steps") {
      settings.steps = std::max(1, std::atoi(argv[i]));
    } else if (option == "--ccd") {
      settings.test = std::strcmp(argv[i], "elementary") == 0 ? ElementaryTest::Elementary : ElementaryTest::Certified;
    } else {
      return false;
    }
  }
  if (settings.triangles.empty()) settings.triangles = {3000, 10'000, 120'000, 1'000'000};
  return true;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  dismantle::Settings settings;
  if (!dismantle::parse(argc, argv, settings)) {
    std::fprintf(stderr,
                 "usage: bench_streams [--device cpu|cuda] [--threads N] [--clearance MM] [--steps N] [--ccd "
                 "certified|elementary] "
                 "[TRIANGLES...]\n");
    return 2;
  }
  std::printf(
      "triangles\tbuild_ms\tvertices_ms\trefit_ms\tfront_ms\tintersection_ms\toverall_ms\tmedian_ms\tp99_ms\tfront\t"
      "triangle_pairs\ttests\tblocked\n");
  for (const std::size_t triangles : settings.triangles) dismantle::run(settings, triangles);
  return 0;
}
