// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/evaluation.h"

#include "bench/paper/append_times.h"
#include "bench/paper/paper_scenes.h"
#include "bench/paper/tunnel_count.h"
#include "dismantle/exec/cuda_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>

namespace dismantle {

namespace {

constexpr PaperMethod kMethods[] = {PaperMethod::FrontBased,        PaperMethod::FrontBasedRigid,
                                    PaperMethod::StreamsElementary, PaperMethod::StreamsCertified,
                                    PaperMethod::Certificates,      PaperMethod::ObbDiscrete};
constexpr PaperMethod kContinuous[] = {PaperMethod::FrontBased, PaperMethod::FrontBasedRigid,
                                       PaperMethod::StreamsElementary, PaperMethod::StreamsCertified,
                                       PaperMethod::Certificates};
constexpr const char* kCoreScene = "lathe";  // the largest of the samples
constexpr int kSizeSteps = 30;
constexpr std::size_t kAppendTriangles = 120'000;
constexpr int kAppendSteps = 10;

/// A number with three significant digits or more.
std::string number(double value) {
  const int decimals = value >= 100 ? 0 : value >= 10 ? 1 : value >= 1 ? 2 : 3;
  return fmt::format("{:.{}f}", value, decimals);
}

void add_row(ResultTable& table, std::vector<std::string> row) {
  if (table.rows.empty()) std::printf("\n%s", csv_of({table.columns, {}}).c_str());
  std::printf("%s", csv_of({row, {}}).c_str());
  std::fflush(stdout);
  table.rows.push_back(std::move(row));
}

using Runs = std::map<PaperMethod, MethodRun>;

void add_steps(Evaluation& e, const std::string& assembly, std::size_t triangles, const MethodRun& run) {
  const TableTimes mean = mean_times(run);
  add_row(e.steps,
          {assembly, std::to_string(triangles), std::string(name_of(run.method)), std::to_string(run.cores),
           std::to_string(run.times.size()), std::to_string(run.reached), number(mean.refit), number(mean.intersection),
           number(mean.overall), number(overall_quantile(run, 0.5)), number(overall_quantile(run, 0.99))});
}

Runs run_all(Evaluation& e, const EvaluationOptions& options, const BenchScene& scene) {
  Runs runs;
  for (const PaperMethod method : kMethods) {
    runs[method] = run_method(method, scene, options.cores, options.repeats);
    add_steps(e, scene.name, triangle_count(scene.assembly), runs[method]);
  }
  std::map<PaperMethod, PaperMethod> same{{PaperMethod::FrontBasedRigid, PaperMethod::FrontBased},
                                          {PaperMethod::StreamsElementary, PaperMethod::FrontBased}};
  if (cuda_device_name()) {
    same[PaperMethod::StreamsCuda] = PaperMethod::FrontBased;
    same[PaperMethod::CertificatesCuda] = PaperMethod::Certificates;
    for (const PaperMethod method : {PaperMethod::StreamsCuda, PaperMethod::CertificatesCuda}) {
      runs[method] = run_method(method, scene, options.cores, options.repeats);
      add_steps(e, scene.name, triangle_count(scene.assembly), runs[method]);
    }
  }
  for (const auto& [method, other] : same) e.equal_poses = e.equal_poses && runs[method].poses == runs[other].poses;
  return runs;
}

void add_speed_ups(Evaluation& e, const BenchScene& scene, const Runs& runs) {
  const double base = mean_times(runs.at(PaperMethod::FrontBased)).overall;
  const std::size_t triangles = triangle_count(scene.assembly);
  e.speed_up_chart.groups.push_back(fmt::format("{} {:.0f}k", scene.name, static_cast<double>(triangles) / 1000));
  std::vector<std::string> row{scene.name, std::to_string(triangles)};
  for (std::size_t s = 0; s + 1 < std::size(kContinuous); ++s) {
    const double ratio = base / mean_times(runs.at(kContinuous[s + 1])).overall;
    row.push_back(number(ratio));
    e.speed_up_chart.series[s].y.push_back(ratio);
    if (kContinuous[s + 1] == PaperMethod::StreamsElementary) e.min_speed_up = std::min(e.min_speed_up, ratio);
  }
  e.speed_up.rows.push_back(std::move(row));
}

void add_stages(Evaluation& e, const BenchScene& scene, const Runs& runs) {
  for (const PaperMethod method :
       {PaperMethod::FrontBased, PaperMethod::FrontBasedRigid, PaperMethod::StreamsElementary}) {
    StageTimings sum;
    for (const StageTimings& t : runs.at(method).stages) {
      sum.vertices += t.vertices;
      sum.refit += t.refit;
      sum.front += t.front;
      sum.intersection += t.intersection;
    }
    const auto mean = [&](double ms) { return number(ms / static_cast<double>(runs.at(method).stages.size())); };
    e.stages.rows.push_back({scene.name, std::to_string(triangle_count(scene.assembly)), std::string(name_of(method)),
                             mean(sum.vertices), mean(sum.refit), mean(sum.front), mean(sum.intersection)});
  }
}

void measure_cores(Evaluation& e, const EvaluationOptions& options, const BenchScene& scene, const Runs& on_all) {
  for (const PaperMethod method : kContinuous) {
    ChartSeries series{std::string(name_of(method)), {}, {}};
    double on_one = 0;
    for (int cores = 1; cores <= options.cores; ++cores) {
      const double ms =
          mean_times(cores == options.cores ? on_all.at(method) : run_method(method, scene, cores, options.repeats))
              .overall;
      if (cores == 1) on_one = ms;
      series.x.push_back(cores);
      series.y.push_back(ms);
      add_row(e.cores, {scene.name, std::to_string(triangle_count(scene.assembly)), series.name, std::to_string(cores),
                        number(ms), number(on_one / ms)});
    }
    e.core_chart.series.push_back(std::move(series));
  }
}

Result<Done> measure_assemblies(Evaluation& e, const EvaluationOptions& options) {
  for (std::size_t s = 1; s < std::size(kContinuous); ++s)
    e.speed_up_chart.series.push_back({std::string(name_of(kContinuous[s])), {}, {}});
  for (const PaperRow& row : paper_table()) {
    const Result<PaperScene> scene = make_paper_scene(row, options.samples_folder);
    if (!scene) return scene.error();
    for (const BenchScene* sized : {&scene->simplified, &scene->full}) {
      const Runs runs = run_all(e, options, *sized);
      add_speed_ups(e, *sized, runs);
      if (sized != &scene->full) continue;
      add_stages(e, *sized, runs);
      if (sized->name == kCoreScene) measure_cores(e, options, *sized, runs);
    }
  }
  return Done{};
}

Result<Done> measure_sizes(Evaluation& e, const EvaluationOptions& options) {
  for (const PaperMethod method : kContinuous) e.size_chart.series.push_back({std::string(name_of(method)), {}, {}});
  for (const std::size_t triangles : {5'000, 20'000, 100'000, 300'000, 1'000'000, 3'000'000, 10'000'000}) {
    if (triangles > options.largest) break;
    const Result<std::vector<BenchScene>> made = make_bench_scenes("shaft_100um", {triangles, kSizeSteps}, "");
    if (!made) return made.error();
    const BenchScene& scene = made->front();
    const std::size_t count = triangle_count(scene.assembly);
    MethodRun base;
    for (std::size_t s = 0; s < std::size(kContinuous); ++s) {
      const MethodRun run = run_method(kContinuous[s], scene, options.cores, options.repeats);
      const double ms = mean_times(run).overall;
      if (run.method == PaperMethod::FrontBased) base = run;
      if (run.method == PaperMethod::StreamsElementary) {
        e.min_speed_up_of_shafts = std::min(e.min_speed_up_of_shafts, mean_times(base).overall / ms);
        e.equal_poses = e.equal_poses && run.poses == base.poses;
      }
      e.size_chart.series[s].x.push_back(static_cast<double>(count));
      e.size_chart.series[s].y.push_back(ms);
      add_row(e.sizes, {std::to_string(count), e.size_chart.series[s].name, std::to_string(run.times.size()),
                        std::to_string(run.reached), number(ms), number(overall_quantile(run, 0.99))});
    }
  }
  return Done{};
}

Result<Done> measure_appends(Evaluation& e, const EvaluationOptions& options) {
  const Result<std::vector<BenchScene>> made = make_bench_scenes("shaft_100um", {kAppendTriangles, kAppendSteps}, "");
  if (!made) return made.error();
  const BenchScene& scene = made->front();
  const auto measure = [&](const AppendRuns& runs, const std::string& on) {
    const Result<std::vector<AppendTime>> times = time_appends(scene, runs);
    for (std::size_t k = 0; times && k < times->size(); ++k) {
      const AppendTime& time = (*times)[k];
      add_row(e.appends, {std::string(name_of(time.variant)), on, number(time.start_ms), std::to_string(time.started),
                          number(time.update_ms), std::to_string(time.updated)});
    }
  };
  AppendRuns runs;
  runs.repeats = 3 * options.repeats;
  for (runs.cores = 1; runs.cores <= options.cores; ++runs.cores) measure(runs, std::to_string(runs.cores));
  runs.on_device = true;
  if (cuda_device_name()) measure(runs, "CUDA");
  return Done{};
}

void measure_tunnels(Evaluation& e) {
  const std::vector<TunnelMethod> methods = tunnel_methods();
  for (const TunnelCase& tunnel_case : tunnel_cases()) {
    const std::vector<TunnelCount> counts = count_tunnels(tunnel_case, methods);
    for (std::size_t m = 0; m < methods.size(); ++m)
      add_row(e.tunnels,
              {tunnel_case.name, methods[m].name, std::to_string(counts[m].steps), std::to_string(counts[m].meeting),
               std::to_string(counts[m].tunnels), std::to_string(counts[m].false_stops)});
  }
}

Evaluation empty_evaluation() {
  Evaluation e;
  e.steps.columns = {"assembly",  "triangles",         "method",  "cores",  "steps", "reached",
                     "BVH refit", "intersection test", "overall", "median", "p99"};
  e.speed_up.columns = {"assembly", "triangles"};
  for (std::size_t s = 1; s < std::size(kContinuous); ++s) e.speed_up.columns.emplace_back(name_of(kContinuous[s]));
  e.stages.columns = {"assembly", "triangles", "method", "vertices", "refit", "front", "tests"};
  e.cores.columns = {"assembly", "triangles", "method", "cores", "overall", "speed-up over one core"};
  e.sizes.columns = {"triangles", "method", "steps", "reached", "overall", "p99"};
  e.appends.columns = {"variant", "cores", "start", "values at the start", "update", "values at an update"};
  e.tunnels.columns = {"case", "method", "steps", "meeting", "tunnels", "false stops"};
  e.speed_up_chart = {"Speed-up over the front-based baseline", "times as fast", {}, {}};
  e.core_chart = {"Time of a step and cores", "cores", "ms per step", {}};
  e.size_chart = {"Time of a step and triangles: a shaft in its hole", "triangles", "ms per step", {}};
  return e;
}

}  // namespace

Result<Evaluation> evaluate(const EvaluationOptions& options) {
  Evaluation e = empty_evaluation();
  measure_tunnels(e);
  for (const auto& measure : {measure_appends, measure_sizes, measure_assemblies}) {
    const Result<Done> done = measure(e, options);
    if (!done) return done.error();
  }
  return e;
}

}  // namespace dismantle
