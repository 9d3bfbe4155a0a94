// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/evaluation_page.h"

#include "bench/paper/paper_scenes.h"
#include "dismantle/exec/cuda_device.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>

namespace dismantle {

namespace {

constexpr const char* kIntroduction = R"(# Evaluation against Du et al. 2015

Table 1 and figure 9 of the paper, measured again with its baselines on our own models of its four assemblies
([samples](../samples/README.md)). One command printed every number on this page and wrote the page, the pictures and the
[tables](evaluation/):

    cmake --preset release && cmake --build --preset release --target bench_paper
    {command}

{date}; {processor}, {cores} cores (load {load_before:.1f} before, {load_after:.1f} after: other work on the machine
lengthens times); {compiler}. {device}

## Methods
Each method plays an assembly's bundled motion with the paper's response: a step that collides is not made. Wall time of one step
in ms, all its sweeps together; the first step of each move, which builds fronts, is left out.

- *front-based*: multi-core continuous detection by front-based decomposition (Tang, Manocha, Tong 2010), the paper's baseline: the whole
  hierarchy is refit, the front cut into one part for each core; elementary cubic tests with representative triangles. Its hierarchy is that of
  *streams*. Where the original prunes, it restarts its front by the rule of *streams*.
- *front-based (rigid)*: the same with knowledge of which components move: stationary ones are neither refit nor tested. No published method;
  it shows the effect of that knowledge alone.
- *streams (elementary)*: the paper's method on the CPU, with the paper's tests. *streams (certified)*: with tests that miss nothing.
- *certificates*: the default method. It also guards vertices inside solids, which the others here do not.
- *boxes (discrete)*: trees of oriented boxes down to the triangles, tested at the targets alone, as in earlier disassembly systems; pairs that
  touch when assembled are ignored. It is fast because it does not test the motion between targets.

Pairs that touch, fit or overlap when assembled are decided by certified and discrete tests in all methods with fronts; the original baseline
does not handle them. {equal}
)";

constexpr const char* kTable1 = R"(
## Table 1: the paper's method, stage by stage
*streams (elementary)* on {cores} cores; *intersection test* is the front and the tests of triangles. Beside it the paper's times of its own models,
simplified, on a Tesla K20c: another machine and other models, so only an indication of scale.

{ours}
{paper}
## All methods
`reached`: steps that reached their targets. Methods with different tests stop at different poses and continue from there.

{all}
## Figure 9: speed-up over the front-based baseline
Mean overall time of the baseline over that of the method, on {cores} cores. *streams (elementary)* is at least {min:.1f} times as fast on the assemblies and
{min_of_shafts:.1f} times on the shafts [below](#size), at equal results. (The paper reports 6 to 8 times for its GPU over four cores.)

![Speed-up over the front-based baseline](pictures/evaluation-figure9.svg)

{speed_up}
## Stages
Mean times of the stages, in ms:

{stages}
From *front-based* to *front-based (rigid)*: most components are stationary, and most of the front lies between stationary neighbours. From there to
*streams*: a separating axis is tested for a whole pair of triangles before its features are tested one by one, and once a contact is known,
certified tests end at its time (tests); resting nodes are kept out of the list that is traversed, and the next ones of it are prefetched (front).
)";

constexpr const char* kCurves = R"(
## Cores
![Time of a step and cores](pictures/evaluation-cores.svg)

{core_table}
## Size
A shaft slides and wobbles in its hole with a clearance of 0.1 mm, on {cores} cores. Larger sizes: `--largest`.

![Time of a step and triangles](pictures/evaluation-sizes.svg)

{size_table}
## Appending to streams
The paper appends by atomic additions to global memory and compares with buffers local to a group (Tang, Manocha, Lin, Tong 2011). The kernel of the
front over the shaft, on the CPU and, if there is one, on the GPU: a front that starts from its root, and one that is updated. Mean ms of a launch, and
values appended by the last.

{append_table}
## Tunnels
Single steps: a cube through a thin plate; a shaft out of its housing, along the bore or through the wall. `meeting`: steps on which the two overlap more
than allowed, by the [audit](guarantee.md), which shares no code with the methods. `tunnels`: of these, steps that a method lets pass. `false stops`:
steps that it stops although nothing is in the way.

{tunnel_table}
## GPU
{gpu}
)";

constexpr const char* kNoGpu = "**No GPU was available: nothing here ran on one.**";
constexpr const char* kNoGpuTimes =
    "This machine has none. *streams* and *certificates* run on CUDA devices too ([docs/gpu.md](gpu.md)): the results "
    "of "
    "a machine with one are\nin [bench/RESULTS.md](../bench/RESULTS.md#gpu).";
constexpr const char* kGpuTimes =
    "The rows *streams (elementary, CUDA)* and *certificates (CUDA)* under [All methods](#all-methods) are those of "
    "the GPU ([docs/gpu.md](gpu.md)).";

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

ResultTable rows_of(const ResultTable& table, const std::string& column, const std::string& value) {
  const auto index =
      static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin());
  ResultTable chosen{table.columns, {}};
  for (const std::vector<std::string>& row : table.rows)
    if (row[index] == value) chosen.rows.push_back(row);
  return chosen;
}

ResultTable paper_rows() {
  ResultTable table{{"the paper's", "triangles", "simplified", "BVH refit", "intersection test", "overall"}, {}};
  for (const PaperRow& row : paper_table())
    table.rows.push_back({row.assembly, std::to_string(row.triangles), std::to_string(row.simplified),
                          fmt::format("{:g}", row.refit), fmt::format("{:g}", row.intersection),
                          fmt::format("{:g}", row.overall)});
  return table;
}

}  // namespace

double present_load() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

EvaluationSetting present_setting(const std::string& command, int cores) {
  EvaluationSetting setting;
  setting.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
  setting.processor = processor_name();
  setting.compiler = std::string("compiler ") + __VERSION__;
  setting.gpu = cuda_device_name() ? *cuda_device_name() : "";
  setting.command = command;
  setting.cores = cores;
  setting.load_before = present_load();
  return setting;
}

std::string evaluation_page(const Evaluation& e, const EvaluationSetting& s) {
  using fmt::arg;
  const std::string equal =
      e.equal_poses
          ? "After every step of every motion *front-based*, *front-based (rigid)* and *streams (elementary)* had the "
            "moving set at the same pose, bit for bit."
          : "**Methods that must stop at the same poses did not: the times cannot be compared.**";
  std::string page =
      fmt::format(kIntroduction, arg("command", s.command), arg("date", s.date), arg("processor", s.processor),
                  arg("cores", s.cores), arg("load_before", s.load_before), arg("load_after", s.load_after),
                  arg("compiler", s.compiler),
                  arg("device", s.gpu.empty() ? std::string(kNoGpu) : "GPU: " + s.gpu + "."), arg("equal", equal));
  const ResultTable ours = rows_of(e.steps, "method", std::string(name_of(PaperMethod::StreamsElementary)));
  page += fmt::format(kTable1, arg("cores", s.cores),
                      arg("ours", markdown_of(columns_of(
                                      ours, {"assembly", "triangles", "BVH refit", "intersection test", "overall"}))),
                      arg("paper", markdown_of(paper_rows())), arg("all", markdown_of(e.steps)),
                      arg("min", e.min_speed_up), arg("min_of_shafts", e.min_speed_up_of_shafts),
                      arg("speed_up", markdown_of(e.speed_up)), arg("stages", markdown_of(e.stages)));
  page += fmt::format(kCurves, arg("cores", s.cores), arg("core_table", markdown_of(e.cores)),
                      arg("size_table", markdown_of(e.sizes)), arg("append_table", markdown_of(e.appends)),
                      arg("tunnel_table", markdown_of(e.tunnels)), arg("gpu", s.gpu.empty() ? kNoGpuTimes : kGpuTimes));
  return page;
}

std::vector<EvaluationFile> evaluation_files(const Evaluation& e, const EvaluationSetting& setting) {
  return {{"evaluation/steps.csv", csv_of(e.steps)},
          {"evaluation/figure9.csv", csv_of(e.speed_up)},
          {"evaluation/stages.csv", csv_of(e.stages)},
          {"evaluation/cores.csv", csv_of(e.cores)},
          {"evaluation/sizes.csv", csv_of(e.sizes)},
          {"evaluation/appends.csv", csv_of(e.appends)},
          {"evaluation/tunnels.csv", csv_of(e.tunnels)},
          {"pictures/evaluation-figure9.svg", svg_of(e.speed_up_chart)},
          {"pictures/evaluation-cores.svg", svg_of(e.core_chart)},
          {"pictures/evaluation-sizes.svg", svg_of(e.size_chart)},
          {"evaluation.md", evaluation_page(e, setting)}};
}

}  // namespace dismantle
