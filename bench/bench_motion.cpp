// SPDX-License-Identifier: Apache-2.0
// Time a step of a method as the loop of a host program sees it, over named scenes; where FCL is there, its discrete
// test at the same poses beside it.
//   bench_motion [--method certificates|streams]... [--device cpu|cuda] [--triangles N] [--threads N] [--steps N]
//                [--response stop|touch|slide] [--samples FOLDER] [SCENE...]
// One row a scene and method, tab-separated. Times are processor time with one thread, wall time with more or on a GPU.
// The first step builds the front and is not among the times, but given by itself. `reached`: the share of the steps
// that reached their targets; of FCL, of the poses that it finds free. `ratio`: how many times as long as the first
// method's mean step over the same poses the row's mean step takes.
#include "bench/motion_scenes.h"
#include "dismantle/collision/choose_certificate_device.h"
#ifdef DISMANTLE_WITH_FCL
#include "bench/fcl_baseline.h"
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <optional>

namespace dismantle {
namespace {

struct Settings {
  std::vector<std::string> methods, scenes;
  BenchSize size;
  DeviceChoice device = DeviceChoice::Cpu;
  int threads = 1;
  std::optional<ResponseKind> response;  // absent: the richest that the method has
  std::string samples_folder = DISMANTLE_SOURCE_DIR "/samples";
};

/// What a method made of a scene.
struct Measured {
  std::string method;
  double build_ms = 0, first_us = 0;
  std::vector<double> us;  // a step
  std::size_t front = 0;
  std::size_t answered = 0;  // elementary tests that a device answered, in all steps
  double reached = 0;        // share of the steps
};

/// Where the components were after a step, and which were in hand.
struct Visited {
  const BenchMove* move = nullptr;
  std::vector<Pose> poses;
};

/// Wall time; where one thread does all that thread's processor time, which other work on the machine does not
/// lengthen.
class Stopwatch {
 public:
  Stopwatch() : clock_(CLOCK_THREAD_CPUTIME_ID), start_(now()) {}
  explicit Stopwatch(const Settings& settings)
      : clock_(settings.threads > 1 || settings.device != DeviceChoice::Cpu ? CLOCK_MONOTONIC
                                                                            : CLOCK_THREAD_CPUTIME_ID),
        start_(now()) {}
  double us() const { return now() - start_; }

 private:
  double now() const {
    timespec time{};
    clock_gettime(clock_, &time);
    return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
  }

  clockid_t clock_;
  double start_;
};

void note_cpu(const std::string& why) {
  if (!why.empty()) std::fprintf(stderr, "bench_motion: on the CPU (%s)\n", why.c_str());
}

std::unique_ptr<MotionEngine> make_engine(const std::string& method, const BenchScene& scene,
                                          const Settings& settings) {
  const Executor executor = settings.threads > 1 ? Executor(ExecutorKind::Threads, settings.threads) : Executor();
  if (method == "certificates") {
    ChosenCertificateDevice chosen = choose_certificate_device(scene.assembly, settings.device);
    note_cpu(chosen.why);
    const CertificateOptions options{executor, widest_lanes()};
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
  const Stopwatch building(settings);
  const std::unique_ptr<MotionEngine> engine = make_engine(method, scene, settings);
  m.build_ms = building.us() / 1e3;
  const ResponseKind response = response_for(*engine, settings);
  int steps = 0, reached = 0;
  for (const BenchMove& move : scene.moves) {
    engine->hold(move.components);
    for (std::size_t k = 0; k < move.targets.size(); ++k) {
      const Stopwatch stepping(settings);
      const StepResult result = engine->step(move.targets[k], response);
      const double us = stepping.us();
      if (k == 0) {
        m.first_us = std::max(m.first_us, us);
        continue;
      }
      m.us.push_back(us);
      m.front = std::max(m.front, result.sizes.front);
      m.answered += result.sizes.answered_tests;
      ++steps;
      reached += result.reached ? 1 : 0;
      visited.push_back({&move, {engine->poses().begin(), engine->poses().end()}});
    }
  }
  m.reached = static_cast<double>(reached) / std::max(1, steps);
  return m;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

void print_row(const BenchScene& scene, const Settings& settings, Measured m, double base) {
  if (m.us.empty()) return;
  const double average = mean(m.us);
  std::sort(m.us.begin(), m.us.end());
  std::printf("%s\t%zu\t%s\t%d\t%zu\t%.0f\t%.0f\t%.1f\t%.1f\t%.1f\t%.1f\t%zu\t%zu\t%.3f\t%.2f\n", scene.name.c_str(),
              triangle_count(scene.assembly), m.method.c_str(), m.method.rfind("fcl", 0) == 0 ? 1 : settings.threads,
              m.us.size(), m.build_ms, m.first_us, m.us[m.us.size() / 2], average, m.us[m.us.size() * 99 / 100],
              m.us.back(), m.front, m.answered, m.reached, average / base);
  std::fflush(stdout);
}

#ifdef DISMANTLE_WITH_FCL
/// FCL's discrete test at the poses where the first method was, and the same of those poses alone at which it finds
/// nothing: at a contact it is done with the first triangle pair that it meets.
void run_fcl(const BenchScene& scene, const Settings& settings, const std::vector<Visited>& visited,
             const Measured& first) {
  Measured all, apart, first_apart;
  all.method = "fcl discrete";
  apart.method = "fcl discrete, apart";
  const Stopwatch building;
  const DiscreteFcl fcl(scene.assembly);
  all.build_ms = building.us() / 1e3;
  for (std::size_t k = 0; k < visited.size(); ++k) {
    const Stopwatch stepping;
    const bool free = fcl.colliding_pairs(visited[k].move->components, visited[k].poses) == 0;
    const double us = stepping.us();
    all.us.push_back(us);
    if (!free) continue;
    apart.us.push_back(us);
    first_apart.us.push_back(first.us[k]);
  }
  all.reached = static_cast<double>(apart.us.size()) / static_cast<double>(std::max<std::size_t>(1, all.us.size()));
  apart.reached = 1;
  print_row(scene, settings, all, mean(first.us));
  if (apart.us.size() < all.us.size()) print_row(scene, settings, apart, mean(first_apart.us));
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
    print_row(scene, settings, std::move(m), mean(first->us));
  }
#ifdef DISMANTLE_WITH_FCL
  run_fcl(scene, settings, first_visited, *first);
#endif
}

bool parse(int argc, char** argv, Settings& settings) {
  static const std::map<std::string, ResponseKind> kResponses{
      {"stop", ResponseKind::Stop}, {"touch", ResponseKind::Touch}, {"slide", ResponseKind::Slide}};
  const std::vector<std::string> methods = {"certificates", "streams"};
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option.rfind("--", 0) != 0) {
      settings.scenes.push_back(option);
      continue;
    }
    if (++i == argc) return false;
    const std::string value = argv[i];
    if (option == "--method" && std::find(methods.begin(), methods.end(), value) != methods.end()) {
      settings.methods.push_back(value);
    } else if (option == "--device" && (value == "cpu" || value == "cuda")) {
      settings.device = value == "cuda" ? DeviceChoice::Cuda : DeviceChoice::Cpu;
    } else if (option == "--triangles") {
      settings.size.triangles = std::strtoull(argv[i], nullptr, 10);
    } else if (option == "--threads") {
      settings.threads = std::max(1, std::atoi(argv[i]));
    } else if (option == "--steps") {
      settings.size.steps = std::max(1, std::atoi(argv[i]));
    } else if (option == "--response" && kResponses.count(value) > 0) {
      settings.response = kResponses.at(value);
    } else if (option == "--samples") {
      settings.samples_folder = value;
    } else {
      return false;
    }
  }
  if (settings.methods.empty()) settings.methods = methods;
  if (settings.scenes.empty()) settings.scenes = bench_scene_names();
  return true;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  using namespace dismantle;
  Settings settings;
  if (!parse(argc, argv, settings)) {
    std::fprintf(
        stderr,
        "usage: bench_motion [--method certificates|streams]... [--device cpu|cuda] [--triangles N] [--threads "
        "N]\n                    [--steps N] [--response stop|touch|slide] [--samples FOLDER] [SCENE...]\nscenes:");
    for (const std::string& name : bench_scene_names()) std::fprintf(stderr, " %s", name.c_str());
    std::fprintf(stderr, "\n");
    return 2;
  }
  std::printf(
      "scene\ttriangles\tmethod\tthreads\tsteps\tbuild_ms\tfirst_us\tmedian_us\tmean_us\tp99_us\tmax_"
      "us\tfront\tanswered_tests\treached\t"
      "ratio\n");
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
