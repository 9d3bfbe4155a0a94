// SPDX-License-Identifier: Apache-2.0
// Time of a batch of candidate motions: some components of an assembly, each from the assembled state along many
// straight motions and screws in random directions.
//   bench_candidates [--device cpu|cuda] [--threads N] [--count N] [--screws N] [ASSEMBLY]
// Two rows a component, tab-separated: --count straight motions of up to 50 mm, and --screws screws (a tenth as many).
// Wall time. The row "state" before them is of 10 straight motions: nearly all of it is what is found once for a state.
#include "bench/assembly_input.h"
#include "bench/command_line.h"
#include "dismantle/candidates/motion_batch.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/streams/stage_clock.h"

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>

namespace dismantle {
namespace {

struct Settings {
  DeviceChoice device = DeviceChoice::Cpu;
  int threads = 2;
  std::size_t count = 20'000, screws = 0;  // screws: 0 is a tenth of count
  std::vector<std::string> assemblies;     // at most one
};

constexpr double kLongest = 50;     // of a straight motion, in each coordinate [mm]
constexpr double kLargestTurn = 1;  // of a screw [rad]
constexpr std::size_t kComponents = 4;
constexpr std::size_t kFew = 10;

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
  std::printf("component\ttriangles\tmotions\tcandidates\tfree\ttotal_ms\tcandidate_us\n");
  std::mt19937_64 random(1);
  std::vector<Vec3> displacements(settings.count);
  for (Vec3& displacement : displacements) displacement = random_vector(random, kLongest);
  std::vector<Pose> targets(settings.screws > 0 ? settings.screws : settings.count / 10);
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
    const std::vector<FirstContact> few = batch.straight_contacts(Span<const Vec3>(displacements).subspan(0, kFew));
    print(assembly, c, "state", few, clock.lap());
    const std::vector<FirstContact> straight = batch.straight_contacts(displacements);
    const double straight_ms = clock.lap();
    const std::vector<FirstContact> turning = batch.screw_contacts(targets);
    const double turning_ms = clock.lap();
    print(assembly, c, "straight", straight, straight_ms);
    print(assembly, c, "screws", turning, turning_ms);
  }
}

bool parse(int argc, char** argv, Settings& settings) {
  bench::CommandLine line("bench_candidates [--device cpu|cuda] [--threads N] [--count N] [--screws N] [ASSEMBLY]");
  line.choice("--device", settings.device, {{"cpu", DeviceChoice::Cpu}, {"cuda", DeviceChoice::Cuda}});
  line.option("--threads", settings.threads, 1);
  line.option("--count", settings.count, kFew);
  line.option("--screws", settings.screws, 1);
  line.words(settings.assemblies);
  return line.parse(argc, argv) && (settings.assemblies.size() <= 1 || line.wrong());
}

int measure(const Settings& settings) {
  const Result<AssemblyFile> input = settings.assemblies.empty()
                                         ? read_sample_input(DISMANTLE_SOURCE_DIR "/samples", "lathe")
                                         : read_assembly_input(settings.assemblies.front());
  if (!input) {
    std::fprintf(stderr, "bench_candidates: %s\n", input.error().message.c_str());
    return bench::kExitUnreadable;
  }
  const Assembly& assembly = input->assembly;
  const Executor executor(ExecutorKind::Threads, settings.threads);
  ClassifyOptions classify;
  classify.executor = executor;
  const Result<PairStates> states = classify_pairs(assembly, classify);
  if (!states) return bench::kExitFailed;
  const ChosenMotionBatch chosen = make_motion_batch(assembly, *states, executor, settings.device);
  if (!chosen.why.empty()) std::fprintf(stderr, "bench_candidates: on the CPU (%s)\n", chosen.why.c_str());
  run(settings, assembly, *chosen.batch);
  return 0;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  dismantle::Settings settings;
  return dismantle::parse(argc, argv, settings) ? dismantle::measure(settings) : dismantle::bench::kExitUsage;
}
