// SPDX-License-Identifier: Apache-2.0
// Candidate motions a second: from an assembly's assembled state, each of some components goes many straight ways, and
// along screws, in all directions.
//   bench_candidates [--device cpu|cuda] [--threads N] [--count N] [ASSEMBLY]
#include "dismantle/collision/classify_pairs.h"
#include "dismantle/collision/motion_batch.h"
#include "dismantle/collision/stage_clock.h"
#include "dismantle/io/load_assembly.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace dismantle {
namespace {

struct Settings {
  DeviceChoice device = DeviceChoice::Cpu;
  int threads = 2;
  std::size_t count = 20'000;
  std::string assembly = DISMANTLE_SOURCE_DIR "/samples/lathe.step";
};

constexpr double kLongest = 50;     // of a way [mm]
constexpr double kLargestTurn = 1;  // of a screw [rad]
constexpr std::size_t kComponents = 4;

Vec3 random_vector(std::mt19937_64& random, double half) {
  std::uniform_real_distribution<double> u(-half, half);
  const double x = u(random), y = u(random), z = u(random);
  return {x, y, z};
}

void print(const Assembly& assembly, ComponentId c, const char* what, const std::vector<FirstContact>& contacts,
           double ms) {
  const auto free = std::count_if(contacts.begin(), contacts.end(), [](const FirstContact& f) { return f.free; });
  std::printf("%s\t%zu\t%s\t%zu\t%zd\t%.1f\t%.2f\n", assembly[c].name.c_str(), assembly[c].mesh->faces.size(), what,
              contacts.size(), static_cast<std::ptrdiff_t>(free), ms, 1e3 * ms / static_cast<double>(contacts.size()));
  std::fflush(stdout);
}

void run(const Settings& settings, const Assembly& assembly, MotionBatch& batch) {
  std::printf("component\ttriangles\tmotions\tcandidates\tfree\tms\tus_each\n");
  std::mt19937_64 random(1);
  std::vector<Vec3> ways(settings.count);
  for (Vec3& way : ways) way = random_vector(random, kLongest);
  std::vector<Pose> targets(settings.count / 10);
  std::uniform_real_distribution<double> turn(-kLargestTurn, kLargestTurn);
  for (Pose& target : targets) {
    target.position = random_vector(random, kLongest / 10);
    target.rotation = quat_about(normalized(random_vector(random, 1)), turn(random));
  }
  const std::size_t count = assembly.components.size();
  for (std::size_t i = 0; i < std::min(kComponents, count); ++i) {
    const ComponentId c(static_cast<std::uint32_t>(i * count / std::min(kComponents, count)));
    batch.set_state(std::vector<Pose>(count), std::vector<ComponentId>{c});
    StageClock clock;
    const std::vector<FirstContact> straight = batch.straight_contacts(ways);
    const double straight_ms = clock.lap();
    const std::vector<FirstContact> turning = batch.screw_contacts(targets);
    const double turning_ms = clock.lap();
    print(assembly, c, "straight", straight, straight_ms);
    print(assembly, c, "screws", turning, turning_ms);
  }
}

bool parse(int argc, char** argv, Settings& settings) {
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option.rfind("--", 0) != 0) {
      settings.assembly = option;
      continue;
    }
    if (++i == argc) return false;
    const std::string value = argv[i];
    if (option == "--device" && (value == "cpu" || value == "cuda")) {
      settings.device = value == "cuda" ? DeviceChoice::Cuda : DeviceChoice::Cpu;
    } else if (option == "--threads") {
      settings.threads = std::max(1, std::atoi(argv[i]));
    } else if (option == "--count") {
      settings.count = std::max<std::size_t>(10, std::strtoull(argv[i], nullptr, 10));
    } else {
      return false;
    }
  }
  return true;
}

int measure(const Settings& settings) {
  const Result<Assembly> assembly = load_assembly(settings.assembly, {});
  if (!assembly) {
    std::fprintf(stderr, "bench_candidates: %s\n", assembly.error().message.c_str());
    return 3;
  }
  const Executor executor(ExecutorKind::Threads, settings.threads);
  ClassifyOptions classify;
  classify.executor = executor;
  const Result<PairStates> states = classify_pairs(*assembly, classify);
  if (!states) return 3;
  const ChosenMotionBatch chosen = make_motion_batch(*assembly, *states, executor, settings.device);
  if (!chosen.why.empty()) std::fprintf(stderr, "bench_candidates: on the CPU (%s)\n", chosen.why.c_str());
  run(settings, *assembly, *chosen.batch);
  return 0;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  dismantle::Settings settings;
  if (dismantle::parse(argc, argv, settings)) return dismantle::measure(settings);
  std::fprintf(stderr, "usage: bench_candidates [--device cpu|cuda] [--threads N] [--count N] [ASSEMBLY]\n");
  return 2;
}
