// SPDX-License-Identifier: Apache-2.0
// Time of the ways in which threads append to the streams of the front, on the CPU or a CUDA device: a shaft in its
// hole, a front that starts from its root and one that is kept.
//   bench_appends [--variant global|local|count-scan-emit]... [--device cpu|cuda] [--threads N] [--triangles N]
//                 [--steps N] [--repeats N]
// One row a variant, tab-separated; mean ms a launch, and how many values the last one appended.
#include "bench/paper/append_times.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace dismantle {
namespace {

struct Settings {
  AppendRuns runs;
  BenchSize size{120'000, 10};
};

bool parse(int argc, char** argv, Settings& settings) {
  static const std::map<std::string, AppendVariant> kNames{{"global", AppendVariant::GlobalLock},
                                                           {"local", AppendVariant::LocalLock},
                                                           {"count-scan-emit", AppendVariant::CountScanEmit}};
  std::vector<AppendVariant> chosen;
  for (int i = 1; i < argc; i += 2) {
    if (i + 1 == argc) return false;
    const std::string option = argv[i], value = argv[i + 1];
    const int number = std::max(1, std::atoi(value.c_str()));
    if (option == "--variant" && kNames.count(value) > 0) {
      chosen.push_back(kNames.at(value));
    } else if (option == "--device" && (value == "cpu" || value == "cuda")) {
      settings.runs.on_device = value == "cuda";
    } else if (option == "--threads") {
      settings.runs.cores = number;
    } else if (option == "--triangles") {
      settings.size.triangles = static_cast<std::size_t>(number);
    } else if (option == "--steps") {
      settings.size.steps = number;
    } else if (option == "--repeats") {
      settings.runs.repeats = number;
    } else {
      return false;
    }
  }
  if (!chosen.empty()) settings.runs.variants = chosen;
  return true;
}

int run(const Settings& settings) {
  const Result<std::vector<BenchScene>> scenes = make_bench_scenes("shaft_100um", settings.size, "");
  const Result<std::vector<AppendTime>> times = time_appends(scenes->front(), settings.runs);
  if (!times) {
    std::fprintf(stderr, "bench_appends: nothing runs on CUDA (%s)\n", times.error().message.c_str());
    return 1;
  }
  std::printf("variant\tstart_ms\tstarted\tupdate_ms\tupdated\n");
  for (const AppendTime& time : *times)
    std::printf("%s\t%.3f\t%zu\t%.3f\t%zu\n", std::string(name_of(time.variant)).c_str(), time.start_ms, time.started,
                time.update_ms, time.updated);
  return 0;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  dismantle::Settings settings;
  if (!dismantle::parse(argc, argv, settings)) {
    std::fprintf(stderr,
                 "usage: bench_appends [--variant global|local|count-scan-emit]... [--device cpu|cuda] [--threads N]\n"
                 "                     [--triangles N] [--steps N] [--repeats N]\n");
    return 2;
  }
  return dismantle::run(settings);
}
