// SPDX-License-Identifier: Apache-2.0
// Time of appending to the streams of the front by global locks, local locks and count-scan-emit, on the CPU or a CUDA
// device, where global locks can also be aggregated by warps. Scene: a shaft in its hole. On a device, the time of the
// kernels; on the CPU, wall time.
//   bench_appends [--variant global|warp|local|count-scan-emit]... [--device cpu|cuda] [--threads N] [--triangles N]
//                 [--steps N] [--repeats N]
// One row a variant, tab-separated: the mean time of a launch and the values that the last one appended, for a front
// that starts from its root and for one that is updated.
#include "bench/command_line.h"
#include "bench/paper/append_times.h"

#include <cstdio>
#include <string>

namespace dismantle {
namespace {

struct Settings {
  AppendRuns runs;
  BenchSize size{120'000, 10};
};

bool parse(int argc, char** argv, Settings& settings) {
  bench::CommandLine line(
      "bench_appends [--variant global|warp|local|count-scan-emit]... [--device cpu|cuda] [--threads N]\n"
      "                     [--triangles N] [--steps N] [--repeats N]");
  std::vector<AppendVariant> chosen;
  line.choices("--variant", chosen,
               {{"global", AppendVariant::GlobalLock},
                {"warp", AppendVariant::WarpAggregated},
                {"local", AppendVariant::LocalLock},
                {"count-scan-emit", AppendVariant::CountScanEmit}});
  line.choice("--device", settings.runs.on_device, {{"cpu", false}, {"cuda", true}});
  line.option("--threads", settings.runs.cores, 1);
  line.option("--triangles", settings.size.triangles, 1);
  line.option("--steps", settings.size.steps, 1);
  line.option("--repeats", settings.runs.repeats, 1);
  if (!line.parse(argc, argv)) return false;
  if (!chosen.empty()) settings.runs.variants = chosen;
  return true;
}

int run(const Settings& settings) {
  const Result<std::vector<BenchScene>> scenes = make_bench_scenes("shaft_100um", settings.size, "");
  const Result<std::vector<AppendTime>> times = time_appends(scenes->front(), settings.runs);
  if (!times) {
    std::fprintf(stderr, "bench_appends: nothing runs on CUDA (%s)\n", times.error().message.c_str());
    return bench::kExitFailed;
  }
  std::printf("variant\tstart_ms\tstart_values\tupdate_ms\tupdate_values\n");
  for (const AppendTime& time : *times)
    std::printf("%s\t%.3f\t%zu\t%.3f\t%zu\n", std::string(name_of(time.variant)).c_str(), time.start_ms, time.started,
                time.update_ms, time.updated);
  return 0;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  dismantle::Settings settings;
  if (!dismantle::parse(argc, argv, settings)) return dismantle::bench::kExitUsage;
  return dismantle::run(settings);
}
