// SPDX-License-Identifier: Apache-2.0
// Plays the same motions on the CPU and on the CUDA device: compares every step bit for bit, and times both.
//   bench_devices [--method certificates|streams]... [--triangles N] [--threads N] [--steps N] [--repeats N]
//                 [--response stop|touch|slide] [--samples FOLDER] [--emulate] [--json FILE] [SCENE...]
// One row a scene and method, tab-separated: wall times of a step on the CPU, then on the device; ratio: mean step of
// the CPU over that of the device. The first step of each move, which builds the front, is not in these times; the
// longest of them is first_ms. --repeats plays so often on the device, and compares each play. --emulate takes the
// emulated device in place of CUDA. --json appends one line a row. Exit code 1 if any step differs.
#include "bench/command_line.h"
#include "bench/motion_scenes.h"
#include "bench/timing.h"
#include "dismantle/certificates/choose_certificate_device.h"
#include "dismantle/exec/cuda_device.h"
#include "dismantle/streams/choose_streams_backend.h"
#include "dismantle/streams/streams_motion_engine.h"

#include <cstdio>
#include <map>
#include <optional>
#include <thread>

namespace dismantle {
namespace {

struct Settings {
  std::vector<std::string> methods, scenes;
  BenchSize size;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  int repeats = 3;
  bool emulate = false;
  std::optional<ResponseKind> response;  // absent: slide where the method can, else touch
  std::string samples_folder = DISMANTLE_SOURCE_DIR "/samples";
  std::string json_file;
};

/// A motion played once.
struct Play {
  double build_ms = 0, first_ms = 0;
  std::vector<double> ms;         // of each step but the first ones
  std::vector<StepResult> steps;  // all
  std::map<std::string_view, double> stage_ms;
  std::string failure;  // of the device, in the middle
};

/// An engine, and whether its device has failed: null on the CPU and on the emulated device.
struct MadeEngine {
  std::unique_ptr<MotionEngine> engine;
  std::shared_ptr<const DeviceFailure> failure;
};

MadeEngine make_engine(const std::string& method, const BenchScene& scene, const Settings& settings, bool on_device) {
  const Executor executor = settings.threads > 1 ? Executor(ExecutorKind::Threads, settings.threads) : Executor();
  if (method == "certificates") {
    const CertificateOptions options{executor, widest_lanes()};
    ChosenCertificateDevice chosen;
    if (on_device && settings.emulate) chosen.use.fronts = make_emulated_front_device(executor);
    if (on_device && !settings.emulate) chosen = choose_certificate_device(DeviceChoice::Cuda);
    return {std::make_unique<CertificateEngine>(scene.assembly, scene.states, options, std::move(chosen.use)),
            chosen.failure};
  }
  CollisionOptions options;
  options.executor = executor;
  ChosenStreamsBackend chosen;
  if (on_device && settings.emulate)
    chosen.backend = make_emulated_streams_backend(scene.assembly, options, executor);
  else
    chosen = choose_streams_backend(scene.assembly, options, on_device ? DeviceChoice::Cuda : DeviceChoice::Cpu);
  return {make_streams_motion_engine(scene.assembly, scene.states, options, std::move(chosen.backend)), chosen.failure};
}

Play play(const std::string& method, const BenchScene& scene, const Settings& settings, bool on_device) {
  Play made;
  const bench::Stopwatch building;
  const MadeEngine used = make_engine(method, scene, settings, on_device);
  MotionEngine* const engine = used.engine.get();
  made.build_ms = building.ms();
  ResponseKind response = engine->can_respond(ResponseKind::Slide) ? ResponseKind::Slide : ResponseKind::Touch;
  if (settings.response && engine->can_respond(*settings.response)) response = *settings.response;
  for (const BenchMove& move : scene.moves) {
    engine->grab(move.components);
    for (std::size_t k = 0; k < move.targets.size(); ++k) {
      const bench::Stopwatch stepping;
      made.steps.push_back(engine->step(move.targets[k], response));
      const double ms = stepping.ms();
      if (k == 0) {
        made.first_ms = std::max(made.first_ms, ms);
        continue;
      }
      made.ms.push_back(ms);
      for (const StageTime& stage : made.steps.back().cost.stages) made.stage_ms[stage.stage] += stage.ms;
    }
  }
  if (used.failure) made.failure = used.failure->why;
  return made;
}

/// The name of the first result in which two steps differ; empty if they are equal. The size of the front is not
/// compared: a device does not keep the nodes of resting pairs.
std::string difference_of(const StepResult& a, const StepResult& b) {
  if (!(a.pose == b.pose && a.reached == b.reached && a.poses == b.poses)) return "poses";
  if (!(a.blocking_pairs == b.blocking_pairs && a.contact_points == b.contact_points)) return "contacts";
  if (a.clearance != b.clearance) return "clearance";
  if (a.sweeps != b.sweeps) return "number of sweeps";
  if (a.cost.triangle_pairs != b.cost.triangle_pairs) return "number of triangle pairs";
  return a.cost.tests == b.cost.tests ? "" : "number of tests";
}

/// The first step that differs, and in what; empty if the plays are equal.
std::string first_difference(const Play& a, const Play& b) {
  for (std::size_t k = 0; k < std::min(a.steps.size(), b.steps.size()); ++k)
    if (const std::string what = difference_of(a.steps[k], b.steps[k]); !what.empty())
      return what + " differ at step " + std::to_string(k);
  return a.steps.size() == b.steps.size() ? "" : "number of steps differs";
}

std::string times_json(const Play& play) {
  char text[400];
  std::snprintf(text, sizeof text,
                "{\"build_ms\": %.3f, \"first_ms\": %.4f, \"mean_ms\": %.4f, \"median_ms\": %.4f, \"p99_ms\": %.4f, "
                "\"max_ms\": %.4f, \"stages_ms\": {",
                play.build_ms, play.first_ms, bench::mean(play.ms), bench::quantile(play.ms, 0.5),
                bench::quantile(play.ms, 0.99), bench::quantile(play.ms, 1));
  std::string json = text;
  bool first = true;
  for (const auto& [stage, ms] : play.stage_ms) {
    std::snprintf(text, sizeof text, "%s\"%s\": %.4f", first ? "" : ", ", std::string(stage).c_str(),
                  ms / static_cast<double>(std::max<std::size_t>(1, play.ms.size())));
    json += text;
    first = false;
  }
  return json + "}}";
}

/// Prints a row. @return false if a step differs
bool compare(const std::string& method, const BenchScene& scene, const Settings& settings,
             const std::string& device_name) {
  const Play on_cpu = play(method, scene, settings, false);
  std::optional<Play> best;
  std::string verdict;
  for (int repeat = 0; repeat < settings.repeats; ++repeat) {
    Play on_device = play(method, scene, settings, true);
    if (verdict.empty() && !on_device.failure.empty()) verdict = "the device failed: " + on_device.failure;
    if (verdict.empty()) verdict = first_difference(on_device, on_cpu);
    if (!best || bench::mean(on_device.ms) < bench::mean(best->ms)) best = std::move(on_device);
  }
  std::size_t tests = 0, device_tests = 0, replays = 0, reached = 0, front = 0, pairs = 0;
  for (const StepResult& step : best->steps) {
    tests += step.cost.tests;
    device_tests += step.cost.device_tests;
    replays += step.cost.replays;
    reached += step.reached ? 1 : 0;
    front = std::max(front, step.cost.pairs);
    pairs = std::max(pairs, step.cost.triangle_pairs);
  }
  const double ratio = bench::mean(on_cpu.ms) / bench::mean(best->ms);
  const bool equal = verdict.empty();
  if (equal) verdict = "equal";
  std::printf("%s\t%zu\t%s\t%zu\t%s\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.2f\t%zu\t%zu\t%zu\t%zu\n",
              scene.name.c_str(), triangle_count(scene.assembly), method.c_str(), best->steps.size(), verdict.c_str(),
              on_cpu.first_ms, bench::quantile(on_cpu.ms, 0.5), bench::quantile(on_cpu.ms, 0.99),
              bench::quantile(on_cpu.ms, 1), best->first_ms, bench::quantile(best->ms, 0.5),
              bench::quantile(best->ms, 0.99), bench::quantile(best->ms, 1), ratio, front, pairs, tests, device_tests);
  std::fflush(stdout);
  if (!settings.json_file.empty()) {
    std::FILE* file = std::fopen(settings.json_file.c_str(), "a");
    if (file != nullptr) {
      std::fprintf(file,
                   "{\"scene\": \"%s\", \"triangles\": %zu, \"method\": \"%s\", \"steps\": %zu, \"reached\": %zu, "
                   "\"plays\": %d, \"equal\": %s, \"device\": \"%s\", \"cpu_threads\": %d, \"cpu\": %s, "
                   "\"on_device\": %s, \"max_front\": %zu, \"max_triangle_pairs\": %zu, \"tests\": %zu, "
                   "\"device_tests\": %zu, \"replays\": %zu}\n",
                   scene.name.c_str(), triangle_count(scene.assembly), method.c_str(), best->steps.size(), reached,
                   settings.repeats, equal ? "true" : "false", device_name.c_str(), settings.threads,
                   times_json(on_cpu).c_str(), times_json(*best).c_str(), front, pairs, tests, device_tests, replays);
      std::fclose(file);
    }
  }
  return equal;
}

bool parse(int argc, char** argv, Settings& settings) {
  std::string usage =
      "bench_devices [--method certificates|streams]... [--triangles N] [--threads N] [--steps N] [--repeats N]\n"
      "              [--response stop|touch|slide] [--samples FOLDER] [--emulate] [--json FILE] [SCENE...]\n"
      "scenes:";
  for (const std::string& name : bench_scene_names()) usage += " " + name;
  bench::CommandLine line(usage);
  line.choices("--method", settings.methods, {{"certificates", "certificates"}, {"streams", "streams"}});
  line.option("--triangles", settings.size.triangles, 1);
  line.option("--threads", settings.threads, 1);
  line.option("--steps", settings.size.steps, 1);
  line.option("--repeats", settings.repeats, 1);
  line.choice("--response", settings.response,
              {{"stop", ResponseKind::Stop}, {"touch", ResponseKind::Touch}, {"slide", ResponseKind::Slide}});
  line.option("--samples", settings.samples_folder);
  line.flag("--emulate", settings.emulate);
  line.option("--json", settings.json_file);
  line.words(settings.scenes);
  if (!line.parse(argc, argv)) return false;
  if (settings.methods.empty()) settings.methods = {"streams", "certificates"};
  if (settings.scenes.empty()) settings.scenes = bench_scene_names();
  return true;
}

int run(const Settings& settings) {
  std::string device_name = "emulated";
  if (!settings.emulate) {
    const Result<std::string> name = cuda_device_name();
    if (!name) {
      std::fprintf(stderr, "bench_devices: nothing was compared (%s)\n", name.error().message.c_str());
      return bench::kExitFailed;
    }
    device_name = *name;
  }
  std::printf(
      "scene\ttriangles\tmethod\tsteps\tbits\tcpu_first_ms\tcpu_median\tcpu_p99\tcpu_max\tfirst_ms\tmedian\tp99\tmax\t"
      "ratio\tfront\ttriangle_pairs\ttests\tdevice_tests\n");
  bool all_same = true;
  for (const std::string& name : settings.scenes) {
    const Result<std::vector<BenchScene>> scenes = make_bench_scenes(name, settings.size, settings.samples_folder);
    if (!scenes) {
      std::fprintf(stderr, "bench_devices: %s\n", scenes.error().message.c_str());
      return bench::kExitUnreadable;
    }
    for (const BenchScene& scene : *scenes)
      for (const std::string& method : settings.methods)
        all_same = compare(method, scene, settings, device_name) && all_same;
  }
  return all_same ? 0 : bench::kExitFailed;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  dismantle::Settings settings;
  return dismantle::parse(argc, argv, settings) ? dismantle::run(settings) : dismantle::bench::kExitUsage;
}
