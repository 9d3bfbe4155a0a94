// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/evaluation.h"

#include "bench/paper/append_times.h"
#include "bench/paper/paper_scenes.h"
#include "bench/paper/tunnel_count.h"
#include "bench/timing.h"
#include "dismantle/exec/cuda_device.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

namespace dismantle {

namespace {

const std::vector<PaperMethod> kTable1 = {PaperMethod::StreamsElementary, PaperMethod::StreamsCuda};
const std::vector<PaperMethod> kFigure9 = {PaperMethod::FrontBased,        PaperMethod::FrontBasedRigid,
                                           PaperMethod::StreamsElementary, PaperMethod::StreamsCuda,
                                           PaperMethod::StreamsGlobalLock, PaperMethod::StreamsCertified,
                                           PaperMethod::Certificates,      PaperMethod::CertificatesCuda,
                                           PaperMethod::ObbDiscrete,       PaperMethod::ObbBoxes};
const std::vector<PaperMethod> kCores = {PaperMethod::FrontBased, PaperMethod::FrontBasedRigid,
                                         PaperMethod::StreamsElementary, PaperMethod::StreamsCertified,
                                         PaperMethod::Certificates};
const std::vector<PaperMethod> kSizes = {PaperMethod::FrontBased,        PaperMethod::FrontBasedRigid,
                                         PaperMethod::StreamsElementary, PaperMethod::StreamsCuda,
                                         PaperMethod::StreamsCertified,  PaperMethod::Certificates};
constexpr const char* kCoreAssembly = "lathe";  // the largest of the samples
constexpr int kSizeSteps = 30;
constexpr std::size_t kAppendTriangles = 120'000;
constexpr int kAppendSteps = 10;
constexpr double kFrameMs = 1000.0 / 30;  // a picture at 30 frames a second

/// A number with four significant digits or more.
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", value >= 100 ? 1 : value >= 10 ? 2 : value >= 1 ? 3 : 4, value);
  return text;
}

std::string number(std::size_t value) {
  return std::to_string(value);
}

using OnRow = std::function<void(const EvaluationTable&)>;

/// A table that prints its rows as they come.
class PrintedTable {
 public:
  PrintedTable(std::vector<std::string> columns, const OnRow& on_row) : on_row_(on_row) {
    made_.table.columns = std::move(columns);
    std::printf("\n%s", csv_of(made_.table).c_str());
  }

  /// @param equal_pose false if this row's method had the moving set elsewhere than others that must agree
  void add(std::vector<std::string> row, bool equal_pose = true) {
    std::printf("%s", csv_of({row, {}}).c_str());
    std::fflush(stdout);
    made_.table.rows.push_back(std::move(row));
    made_.equal_poses = made_.equal_poses && equal_pose;
    on_row_(made_);
  }
  const EvaluationTable& made() const { return made_; }

 private:
  EvaluationTable made_;
  const OnRow& on_row_;
};

PrintedTable steps_table(const OnRow& on_row) {
  return PrintedTable(
      {"assembly",   "triangles",   "pairs",       "method",   "device",           "cores",           "steps",
       "reached",    "vertices_ms", "refit_ms",    "front_ms", "tests_ms",         "overall_ms",      "median_ms",
       "p99_ms",     "longest_ms",  "within_33ms", "plays",    "shortest_play_ms", "longest_play_ms", "embedded_steps",
       "embedded_ms"},
      on_row);
}

/// @param pairs "auto" or "paper", as option --pairs of the program
std::vector<std::string> steps_row(const BenchScene& scene, const std::string& pairs, const MethodRun& run) {
  const StageTimings mean = mean_times(run);
  const std::vector<double> ms = overall_times(run);
  const auto [shortest, longest] = std::minmax_element(run.play_means.begin(), run.play_means.end());
  const auto in_time = std::count_if(ms.begin(), ms.end(), [](double t) { return t <= kFrameMs; });
  std::vector<double> embedded;
  for (std::size_t k = 0; k < ms.size(); ++k)
    if (run.embedded[k] != 0) embedded.push_back(ms[k]);
  return {scene.name,
          number(triangle_count(scene.assembly)),
          pairs,
          std::string(name_of(run.method)),
          needs_cuda(run.method) ? "GPU" : "CPU",
          std::to_string(run.cores),
          number(ms.size()),
          number(run.reached),
          number(mean.vertices),
          number(mean.refit),
          number(mean.front),
          number(mean.intersection),
          number(mean.overall),
          number(bench::quantile(ms, 0.5)),
          number(bench::quantile(ms, 0.99)),
          number(bench::quantile(ms, 1)),
          number(static_cast<double>(in_time) / static_cast<double>(std::max<std::size_t>(1, ms.size()))),
          number(run.play_means.size()),
          number(*shortest),
          number(*longest),
          number(embedded.size()),
          number(bench::mean(embedded))};
}

/// The poses that methods must have reached, by what decides them.
class PoseCheck {
 public:
  /// @return false if a method of the same tests had the moving set elsewhere over this scene
  bool add(const MethodRun& run) {
    std::optional<std::vector<Pose>>& known = poses_[tests_of(run.method)];
    if (known) return *known == run.poses;
    known = run.poses;
    return true;
  }

 private:
  /// Methods with equal results have the same.
  static PaperMethod tests_of(PaperMethod method) {
    switch (method) {
      case PaperMethod::FrontBased:
      case PaperMethod::FrontBasedRigid:
      case PaperMethod::StreamsElementary:
      case PaperMethod::StreamsGlobalLock:
      case PaperMethod::StreamsCuda:
        return PaperMethod::StreamsElementary;
      case PaperMethod::Certificates:
      case PaperMethod::CertificatesCuda:
        return PaperMethod::Certificates;
      default:
        return method;
    }
  }

  std::map<PaperMethod, std::optional<std::vector<Pose>>> poses_;
};

/// Runs methods over a scene on all counts of cores; those on a GPU, or on one core only, once.
void add_runs(PrintedTable& table, const EvaluationOptions& options, const BenchScene& scene, const std::string& pairs,
              const std::vector<PaperMethod>& methods) {
  PoseCheck poses;
  for (const PaperMethod method : methods) {
    if (needs_cuda(method) && !cuda_device_name()) continue;
    const bool once = needs_cuda(method) || is_serial(method);
    for (const int cores : once ? std::vector<int>{options.cores.back()} : options.cores) {
      const MethodRun run = run_method(method, scene, {cores, options.repeats, options.moves});
      table.add(steps_row(scene, pairs, run), poses.add(run));
    }
  }
}

/// @param both_pairs with the paper's pairs as well
Result<EvaluationTable> measure_assemblies(const EvaluationOptions& options, const std::vector<PaperMethod>& methods,
                                           bool both_pairs, const OnRow& on_row) {
  PrintedTable table = steps_table(on_row);
  for (const PaperAssembly& assembly : paper_assemblies()) {
    const std::vector<std::string>& wanted = options.assemblies;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), assembly.name) == wanted.end()) continue;
    const Result<PaperScene> scene = make_paper_scene(assembly, options.samples_folder);
    if (!scene) return scene.error();
    for (const BenchScene* sized : {&scene->simplified, &scene->full}) {
      add_runs(table, options, *sized, "auto", methods);
      if (!both_pairs) continue;
      const Result<BenchScene> paper = with_paper_pairs(*sized);
      if (!paper) return paper.error();
      add_runs(table, options, *paper, "paper", methods);
    }
  }
  return table.made();
}

Result<EvaluationTable> measure_cores(const EvaluationOptions& options, const OnRow& on_row) {
  const Result<std::vector<BenchScene>> scene = make_bench_scenes(kCoreAssembly, {}, options.samples_folder);
  if (!scene) return scene.error();
  EvaluationOptions counts = options;
  counts.cores.clear();
  for (int cores = 1; cores < options.cores.back(); cores *= 2) counts.cores.push_back(cores);
  counts.cores.push_back(options.cores.back());
  PrintedTable table = steps_table(on_row);
  add_runs(table, counts, scene->front(), "auto", kCores);
  return table.made();
}

Result<EvaluationTable> measure_sizes(const EvaluationOptions& options, const OnRow& on_row) {
  EvaluationOptions most = options;
  most.cores = {options.cores.back()};
  PrintedTable table = steps_table(on_row);
  for (const std::size_t triangles : {5'000, 20'000, 100'000, 300'000, 1'000'000, 3'000'000, 10'000'000}) {
    if (triangles > options.largest) break;
    const Result<std::vector<BenchScene>> made = make_bench_scenes("shaft_100um", {triangles, kSizeSteps}, "");
    if (!made) return made.error();
    add_runs(table, most, made->front(), "auto", kSizes);
  }
  return table.made();
}

Result<EvaluationTable> measure_appends(const EvaluationOptions& options, const OnRow& on_row) {
  const Result<std::vector<BenchScene>> made = make_bench_scenes("shaft_100um", {kAppendTriangles, kAppendSteps}, "");
  if (!made) return made.error();
  PrintedTable table({"variant", "device", "cores", "start_ms", "values_at_start", "update_ms", "values_at_update"},
                     on_row);
  const auto measure = [&](const AppendRuns& runs, const char* device) {
    const Result<std::vector<AppendTime>> times = time_appends(made->front(), runs);
    for (std::size_t k = 0; times && k < times->size(); ++k) {
      const AppendTime& time = (*times)[k];
      table.add({std::string(name_of(time.variant)), device, std::to_string(runs.cores), number(time.start_ms),
                 number(time.started), number(time.update_ms), number(time.updated)});
    }
  };
  AppendRuns runs;
  runs.repeats = 3 * options.repeats;
  for (const int cores : options.cores) {
    runs.cores = cores;
    measure(runs, "CPU");
  }
  runs.on_device = true;
  if (cuda_device_name()) measure(runs, "GPU");
  return table.made();
}

Result<EvaluationTable> measure_tunnels(const OnRow& on_row) {
  const std::vector<TunnelMethod> methods = tunnel_methods();
  PrintedTable table({"case", "method", "steps", "meeting", "tunnels", "false_stops"}, on_row);
  for (const TunnelCase& tunnel_case : tunnel_cases()) {
    const std::vector<TunnelCount> counts = count_tunnels(tunnel_case, methods);
    for (std::size_t m = 0; m < methods.size(); ++m)
      table.add({tunnel_case.name, methods[m].name, number(counts[m].steps), number(counts[m].meeting),
                 number(counts[m].tunnels), number(counts[m].false_stops)});
  }
  return table.made();
}

}  // namespace

std::string name_of(EvaluationPart part) {
  switch (part) {
    case EvaluationPart::Table1:
      return "table1";
    case EvaluationPart::Figure9:
      return "figure9";
    case EvaluationPart::Cores:
      return "cores";
    case EvaluationPart::Sizes:
      return "sizes";
    case EvaluationPart::Appends:
      return "appends";
    case EvaluationPart::Tunnels:
      break;
  }
  return "tunnels";
}

Result<EvaluationTable> evaluate(EvaluationPart part, const EvaluationOptions& options, const OnRow& on_row) {
  DISMANTLE_EXPECT(!options.cores.empty() && std::is_sorted(options.cores.begin(), options.cores.end()));
  switch (part) {
    case EvaluationPart::Table1:
      return measure_assemblies(options, kTable1, true, on_row);
    case EvaluationPart::Figure9:
      return measure_assemblies(options, kFigure9, false, on_row);
    case EvaluationPart::Cores:
      return measure_cores(options, on_row);
    case EvaluationPart::Sizes:
      return measure_sizes(options, on_row);
    case EvaluationPart::Appends:
      return measure_appends(options, on_row);
    case EvaluationPart::Tunnels:
      break;
  }
  return measure_tunnels(on_row);
}

}  // namespace dismantle
