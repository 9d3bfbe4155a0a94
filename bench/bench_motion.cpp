// SPDX-License-Identifier: Apache-2.0
// Time of a step of the collision methods as the loop of a host program sees it, over named scenes; FCL's discrete test
// at the same poses, where FCL is installed.
//   bench_motion [--method certificates|streams]... [--device cpu|cuda] [--triangles N] [--threads N] [--steps N]
//                [--response stop|touch|slide] [--samples FOLDER] [SCENE...]
// One row a scene and method, tab-separated. Processor time with one thread; wall time with more, or on a GPU. The
// first step of a move, which builds the front, is left out and given by itself (first_us, the longest of the moves).
// front: the largest number of nodes of the front. device_tests: elementary tests that the device made, in all steps.
// reached: the share of the steps that reached their targets; for FCL, of the poses that it finds free. ratio: the
// row's mean step over the first method's mean step, over the same poses.
#include "bench/command_line.h"
#include "bench/motion_scenes.h"
#include "bench/timing.h"
#include "dismantle/certificates/choose_certificate_device.h"
#include "dismantle/session/step_limit.h"
#include "dismantle/streams/choose_streams_backend.h"
#include "dismantle/streams/streams_motion_engine.h"
#ifdef DISMANTLE_WITH_FCL
#include "bench/fcl_baseline.h"
#endif

#include <algorithm>
#include <cstdio>
#include <optional>

namespace dismantle {
namespace {

struct Settings {
  std::vector<std::string> methods, scenes;
  BenchSize size;
  DeviceChoice device = DeviceChoice::Cpu;
  int threads = 1;
  std::optional<ResponseKind> response;  // absent: slide where the method can, else touch
  std::string samples_folder = DISMANTLE_SOURCE_DIR "/samples";
};

/// Results of a method over a scene.
struct Measured {
  std::string method;
  double build_ms = 0, first_us = 0;
  std::vector<double> us;  // of each step
  std::size_t front = 0;
  std::size_t device_tests = 0;  // in all steps
  double reached = 0;            // share of the steps
};

/// The poses of the components after a step, and the move that the step is of.
struct Visited {
  const BenchMove* move = nullptr;
  std::vector<Pose> poses;
};

/// The clock of the measurements: processor time, which other work on the machine does not lengthen, where one thread
/// does everything.
bench::ClockNs clock_of(const Settings& settings) {
  return settings.threads > 1 || settings.device != DeviceChoice::Cpu ? bench::wall_ns : bench::thread_ns;
}

void note_cpu(const std::string& why) {
  if (!why.empty()) std::fprintf(stderr, "bench_motion: on the CPU (%s)\n", why.c_str());
}

std::unique_ptr<MotionEngine> make_engine(const std::string& method, const BenchScene& scene,
                                          const Settings& settings) {
  const Executor executor = settings.threads > 1 ? Executor(ExecutorKind::Threads, settings.threads) : Executor();
  if (method == "certificates") {
    ChosenCertificateDevice chosen = choose_certificate_device(settings.device);
    note_cpu(chosen.why);
    CertificateOptions options{executor, widest_lanes()};
    limit_steps(options);
    return std::make_unique<CertificateEngine>(scene.assembly, scene.states, options, std::move(chosen.use));
  }
  CollisionOptions options;
  options.executor = executor;
  ChosenStreamsBackend chosen = choose_streams_backend(scene.assembly, options, settings.device);
  note_cpu(chosen.why);
  return make_streams_motion_engine(scene.assembly, scene.states, options, std::move(chosen.backend));
}

ResponseKind response_for(const MotionEngine& engine, const Settings& settings) {
  if (settings.response && engine.can_respond(*settings.response)) return *settings.response;
  return engine.can_respond(ResponseKind::Slide) ? ResponseKind::Slide : ResponseKind::Touch;
}

Measured measure(const std::string& method, const BenchScene& scene, const Settings& settings,
                 std::vector<Visited>& visited) {
  Measured m;
  m.method = method;
  const bench::Stopwatch building(clock_of(settings));
  const std::unique_ptr<MotionEngine> engine = make_engine(method, scene, settings);
  m.build_ms = building.ms();
  const ResponseKind response = response_for(*engine, settings);
  int steps = 0, reached = 0;
  for (const BenchMove& move : scene.moves) {
    engine->grab(move.components);
    for (std::size_t k = 0; k < move.targets.size(); ++k) {
      const bench::Stopwatch stepping(clock_of(settings));
      const StepResult result = engine->step(move.targets[k], response);
      const double us = stepping.us();
      if (k == 0) {
        m.first_us = std::max(m.first_us, us);
        continue;
      }
      m.us.push_back(us);
      m.front = std::max(m.front, result.cost.pairs);
      m.device_tests += result.cost.device_tests;
      ++steps;
      reached += result.reached ? 1 : 0;
      visited.push_back({&move, {engine->poses().begin(), engine->poses().end()}});
    }
  }
  m.reached = static_cast<double>(reached) / std::max(1, steps);
  return m;
}

void print_row(const BenchScene& scene, const Settings& settings, const Measured& m, double base_us) {
  if (m.us.empty()) return;
  std::printf("%s\t%zu\t%s\t%d\t%zu\t%.0f\t%.0f\t%.1f\t%.1f\t%.1f\t%.1f\t%zu\t%zu\t%.3f\t%.2f\n", scene.name.c_str(),
              triangle_count(scene.assembly), m.method.c_str(), m.method.rfind("fcl", 0) == 0 ? 1 : settings.threads,
              m.us.size(), m.build_ms, m.first_us, bench::quantile(m.us, 0.5), bench::mean(m.us),
              bench::quantile(m.us, 0.99), bench::quantile(m.us, 1), m.front, m.device_tests, m.reached,
              bench::mean(m.us) / base_us);
  std::fflush(stdout);
}

#ifdef DISMANTLE_WITH_FCL
/// Times FCL's discrete test at the poses of the first method, and gives a second row for the poses at which it finds
/// no collision: at the others it ends with the first triangle pair that intersects.
void run_fcl(const BenchScene& scene, const Settings& settings, const std::vector<Visited>& visited,
             const Measured& first) {
  Measured all, free_poses, first_free;
  all.method = "fcl discrete";
  free_poses.method = "fcl discrete, free poses";
  const bench::Stopwatch building(bench::thread_ns);
  const DiscreteFcl fcl(scene.assembly);
  all.build_ms = building.ms();
  for (std::size_t k = 0; k < visited.size(); ++k) {
    const bench::Stopwatch stepping(bench::thread_ns);
    const bool free = fcl.colliding_pairs(visited[k].move->components, visited[k].poses) == 0;
    const double us = stepping.us();
    all.us.push_back(us);
    if (!free) continue;
    free_poses.us.push_back(us);
    first_free.us.push_back(first.us[k]);
  }
  all.reached =
      static_cast<double>(free_poses.us.size()) / static_cast<double>(std::max<std::size_t>(1, all.us.size()));
  free_poses.reached = 1;
  print_row(scene, settings, all, bench::mean(first.us));
  if (free_poses.us.size() < all.us.size()) print_row(scene, settings, free_poses, bench::mean(first_free.us));
}
#endif

void run(const BenchScene& scene, const Settings& settings) {
  std::vector<Visited> first_visited;
  std::optional<Measured> first;
  for (const std::string& method : settings.methods) {
    std::vector<Visited> visited;
    Measured m = measure(method, scene, settings, visited);
    if (!first) {
      first = m;
      first_visited = std::move(visited);
    }
    print_row(scene, settings, m, bench::mean(first->us));
  }
#ifdef DISMANTLE_WITH_FCL
  run_fcl(scene, settings, first_visited, *first);
#endif
}

std::string usage() {
  std::string text =
      "bench_motion [--method certificates|streams]... [--device cpu|cuda] [--triangles N] [--threads N]\n"
      "                    [--steps N] [--response stop|touch|slide] [--samples FOLDER] [SCENE...]\n"
      "scenes:";
  for (const std::string& name : bench_scene_names()) text += " " + name;
  return text;
}

bool parse(int argc, char** argv, Settings& settings) {
  bench::CommandLine line(usage());
  line.choices("--method", settings.methods, {{"certificates", "certificates"}, {"streams", "streams"}});
  line.choice("--device", settings.device, {{"cpu", DeviceChoice::Cpu}, {"cuda", DeviceChoice::Cuda}});
  line.option("--triangles", settings.size.triangles, 1);
  line.option("--threads", settings.threads, 1);
  line.option("--steps", settings.size.steps, 1);
  line.choice("--response", settings.response,
              {{"stop", ResponseKind::Stop}, {"touch", ResponseKind::Touch}, {"slide", ResponseKind::Slide}});
  line.option("--samples", settings.samples_folder);
  line.words(settings.scenes);
  if (!line.parse(argc, argv)) return false;
  if (settings.methods.empty()) settings.methods = {"certificates", "streams"};
  if (settings.scenes.empty()) settings.scenes = bench_scene_names();
  return true;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  using namespace dismantle;
  Settings settings;
  if (!parse(argc, argv, settings)) return bench::kExitUsage;
  std::printf(
      "scene\ttriangles\tmethod\tthreads\tsteps\tbuild_ms\tfirst_us\tmedian_us\tmean_us\tp99_us\tmax_us\tfront\t"
      "device_tests\treached\tratio\n");
  for (const std::string& name : settings.scenes) {
    const Result<std::vector<BenchScene>> scenes = make_bench_scenes(name, settings.size, settings.samples_folder);
    if (!scenes) {
      std::fprintf(stderr, "bench_motion: %s\n", scenes.error().message.c_str());
      return static_cast<int>(scenes.error().kind) + 2;
    }
    for (const BenchScene& scene : *scenes) run(scene, settings);
  }
  return 0;
}
