// SPDX-License-Identifier: Apache-2.0
// Success and time of the planner, by tier; every path audited.
//   bench_plan cases [--shapes N] [--poses M] [--seed S] [KIND...]
//     N shapes of each kind of generated case, each as it is and in M random orientations, scales and tessellations
//   bench_plan turned [--poses M] [--seed S] [--from N] [--count N] [ASSEMBLY...]
//     whether the same components come out in M random orientations, scales and tessellations: of these assemblies, or
//     of the generated ones of two components, of which --from and --count choose some of the 200
//   bench_plan products [N...]
//     generated products of about N components
//   bench_plan files [--time-limit S] [--tolerance MM] [--target NAME] ASSEMBLY...
//     assemblies, or one component of each
// --no-audit: plans only. One row a case or an assembly, tab-separated; `cases` adds an empty line and a table with one
// row a kind. out: components that a step takes out by themselves; straight, helical, sliding and together: steps of
// the tiers. good: exactly what is known to come out does, and the audit holds; for assemblies: the plan ended in time,
// and the audit holds. Exit code 1 where a row is not good. Times, --time-limit too, are processor time of one thread
// without reading the file.
#include "bench/assembly_files.h"
#include "bench/command_line.h"
#include "bench/timing.h"
#include "dismantle/audit/audit_path.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"
#include "tests/support/disassembly_cases.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <string>

namespace dismantle {
namespace {

using namespace scenes;

/// Number of the generated cases of two components for `turned`.
constexpr std::size_t kTurnedCases = 200;

/// A plan, the verdict of its audit, and its cost.
struct Planned {
  Plan plan;
  bool audit_holds = false;  ///< Also true where no audit was wanted.
  double classify_seconds = 0, plan_seconds = 0;
};

enum class Audit { Yes, No };

Planned plan_and_audit(const Assembly& assembly, double tolerance, const PlanOptions& options, Audit audit) {
  Planned planned;
  bench::Stopwatch watch(bench::process_ns);
  ClassifyOptions classify;
  classify.tolerance = tolerance;
  const PairStates pairs = classify_pairs(assembly, classify).value();
  planned.classify_seconds = watch.seconds();
  watch = bench::Stopwatch(bench::process_ns);
  planned.plan = plan_disassembly(assembly, pairs, options);
  const Path path = plan_path(assembly, pairs, planned.plan);
  planned.plan_seconds = watch.seconds();
  planned.audit_holds = audit == Audit::No || audit_path(assembly, path).holds();
  return planned;
}

/// The components that some step takes out by themselves.
std::size_t taken_out(const Plan& plan) {
  return static_cast<std::size_t>(std::count_if(plan.steps.begin(), plan.steps.end(),
                                                [](const PlanStep& step) { return step.components.size() == 1; }));
}

/// The cells of a row with the number of steps of each tier.
std::string tiers(const Plan& plan) {
  std::string row;
  for (const PlanTier tier : {PlanTier::Straight, PlanTier::Helical, PlanTier::Sliding, PlanTier::StraightTogether})
    row += '\t' + std::to_string(std::count_if(plan.steps.begin(), plan.steps.end(),
                                               [tier](const PlanStep& step) { return step.tier == tier; }));
  return row;
}

constexpr const char* kTierColumns = "straight\thelical\tsliding\ttogether";

/// Counts and times of all cases of one kind.
struct Tally {
  std::size_t plans = 0, good = 0, false_free = 0;  ///< false_free: of the locked, those of which something comes out.
  std::vector<double> ms;
};

struct Settings {
  int shapes = 3, poses = 1;
  std::uint64_t seed = 1;
  std::size_t from = 0, count = kTurnedCases;
  Audit audit = Audit::Yes;
  double time_limit = 60, tolerance = 0;
  std::string target;
  std::vector<std::string> names;
};

void run_case(CaseKind kind, int shape, const DisassemblyCase& made, double scale, Audit audit, Tally& tally) {
  PlanOptions options;
  for (std::uint32_t c = 0; c < made.fixed; ++c) options.fixed.emplace_back(c);
  const std::size_t others = made.assembly.components.size() - made.fixed;
  const Planned planned = plan_and_audit(made.assembly, 0.01 * scale, options, audit);
  const std::size_t out = taken_out(planned.plan);
  const bool good = out == (comes_apart(kind) ? others : 0) && planned.audit_holds;
  ++tally.plans;
  tally.good += good;
  tally.false_free += !comes_apart(kind) && out > 0;
  tally.ms.push_back(1e3 * planned.plan_seconds);
  std::printf("%s\t%d\t%g\t%zu\t%zu%s\t%.1f\t%.1f\t%s\t%s\n", std::string(name_of(kind)).c_str(), shape, scale, others,
              out, tiers(planned.plan).c_str(), 1e3 * planned.classify_seconds, 1e3 * planned.plan_seconds,
              planned.audit_holds ? "holds" : "BROKEN", good ? "yes" : "NO");
  std::fflush(stdout);
}

bool run_cases(const Settings& settings) {
  std::printf("kind\tshape\tscale\tcomponents\tout\t%s\tclassify_ms\tplan_ms\taudit\tgood\n", kTierColumns);
  bool all_good = true;
  std::vector<std::pair<CaseKind, Tally>> tallies;
  for (const CaseKind kind : kCaseKinds) {
    const std::string name(name_of(kind));
    if (!settings.names.empty() &&
        std::find(settings.names.begin(), settings.names.end(), name) == settings.names.end())
      continue;
    std::mt19937_64 random(settings.seed);
    Tally tally;
    for (int shape = 0; shape < settings.shapes; ++shape) {
      const CaseShape drawn = random_shape(random);
      const DisassemblyCase made = disassembly_case(kind, drawn);
      run_case(kind, shape, made, 1, settings.audit, tally);
      for (int pose = 0; pose < settings.poses; ++pose) {
        const double scale = std::array{0.01, 1.0, 1000.0}[static_cast<std::size_t>(pose) % 3];
        const Pose turned = random_pose(random, 50, 3);
        run_case(kind, shape, {placed(refined(made.assembly, random), turned, scale), made.fixed}, scale,
                 settings.audit, tally);
      }
    }
    all_good = all_good && tally.good == tally.plans;
    tallies.emplace_back(kind, std::move(tally));
  }
  std::printf("\nkind\tplans\tgood\tfalse_free\tmedian_ms\tp99_ms\tmax_ms\n");
  for (const auto& [kind, tally] : tallies)
    std::printf("%s\t%zu\t%zu\t%zu\t%.1f\t%.1f\t%.1f\n", std::string(name_of(kind)).c_str(), tally.plans, tally.good,
                tally.false_free, bench::quantile(tally.ms, 0.5), bench::quantile(tally.ms, 0.99),
                bench::quantile(tally.ms, 1));
  return all_good;
}

/// Prints a row. @return good
bool run_assembly(const std::string& name, const Assembly& assembly, const Settings& settings) {
  PlanOptions options;
  for (std::uint32_t c = 0; c < assembly.components.size(); ++c)
    if (assembly.components[c].name == settings.target) options.targets.emplace_back(c);
  const bench::Stopwatch watch(bench::process_ns);
  options.progress = [&](std::string_view, double) { return watch.seconds() < settings.time_limit; };
  const Planned planned = plan_and_audit(assembly, settings.tolerance, options, settings.audit);
  const bool good = planned.audit_holds && !planned.plan.out_of_time;
  std::printf("%s\t%zu\t%zu\t%zu%s\t%zu\t%.2f\t%.2f\t%s\t%s\n", name.c_str(), assembly.components.size(),
              triangle_count(assembly), taken_out(planned.plan), tiers(planned.plan).c_str(),
              planned.plan.staying.size(), planned.classify_seconds, planned.plan_seconds,
              planned.audit_holds ? "holds" : "BROKEN", good ? "yes" : "NO");
  std::fflush(stdout);
  return good;
}

/// Names of the components that a step takes out by themselves.
std::set<std::string> removed(const Assembly& assembly, const Plan& plan) {
  std::set<std::string> names;
  for (const PlanStep& step : plan.steps)
    if (step.components.size() == 1) names.insert(assembly[step.components[0]].name);
  return names;
}

/// Prints a row on whether the same components come out of an assembly in other orientations, scales and tessellations.
/// @param tolerance of the assembly as it is [mm]; 0: the planner's default
/// @return good
bool run_turned(const std::string& name, const Assembly& assembly, double tolerance, const Settings& settings) {
  std::mt19937_64 random(settings.seed);
  std::set<std::string> expected;
  int same = 0;
  double seconds = 0;
  bool audits_hold = true;
  for (int pose = 0; pose <= settings.poses; ++pose) {
    const double scale = pose == 0 ? 1 : std::array{0.01, 1.0, 1000.0}[static_cast<std::size_t>(pose) % 3];
    Assembly other = assembly;
    if (pose > 0) {
      const Pose turned = random_pose(random, 50, 3);
      other = placed(refined(assembly, random), turned, scale);
    }
    const Planned planned = plan_and_audit(other, tolerance * scale, {}, settings.audit);
    seconds += planned.classify_seconds + planned.plan_seconds;
    audits_hold = audits_hold && planned.audit_holds;
    const std::set<std::string> out = removed(other, planned.plan);
    if (pose == 0) expected = out;
    same += pose > 0 && out == expected;
    if (out != expected) std::fprintf(stderr, "%s: other components at pose %d, scale %g\n", name.c_str(), pose, scale);
  }
  const bool good = same == settings.poses && audits_hold;
  std::printf("%s\t%zu\t%zu\t%d\t%d\t%.2f\t%s\t%s\n", name.c_str(), assembly.components.size(), expected.size(),
              settings.poses, same, seconds, audits_hold ? "holds" : "BROKEN", good ? "yes" : "NO");
  std::fflush(stdout);
  return good;
}

/// Runs the generated case of two components with this index, which is the same in every run. @return good
bool run_turned_case(std::size_t index, const Settings& settings) {
  constexpr CaseKind kPairs[] = {CaseKind::Peg,   CaseKind::Key,         CaseKind::Dovetail,
                                 CaseKind::LSlot, CaseKind::Bayonet,     CaseKind::Screw,
                                 CaseKind::Rivet, CaseKind::ClosedShell, CaseKind::ChainLinks};
  const CaseKind kind = kPairs[index % std::size(kPairs)];
  std::mt19937_64 random(index + 1);
  const std::string name = std::string(name_of(kind)) + ' ' + std::to_string(index);
  return run_turned(name, disassembly_case(kind, random_shape(random)).assembly, 0.01, settings);
}

bool run_all_turned(const Settings& settings) {
  std::printf("case\tcomponents\tout\tposes\tsame\tplan_s\taudit\tgood\n");
  const std::size_t all = settings.names.empty() ? kTurnedCases : settings.names.size();
  const std::size_t end = std::min(all, settings.from + settings.count);
  std::size_t good = 0, done = 0;
  for (std::size_t k = settings.from; k < end; ++k, ++done) {
    if (settings.names.empty()) {
      good += run_turned_case(k, settings);
      continue;
    }
    const std::string& file = settings.names[k];
    const Result<Assembly> assembly = load_assembly(file);
    if (!assembly) std::fprintf(stderr, "bench_plan: %s\n", assembly.error().message.c_str());
    good += assembly && run_turned(file, *assembly, settings.tolerance, settings);
  }
  std::printf("# %zu of %zu cases good\n", good, done);
  return good == done;
}

bool run_file(const std::string& file, const Settings& settings) {
  const Result<Assembly> assembly = load_assembly(file);
  if (assembly) return run_assembly(bench::assembly_name(file), *assembly, settings);
  std::fprintf(stderr, "bench_plan: %s\n", assembly.error().message.c_str());
  return false;
}

bool run_product(const std::string& count, const Settings& settings) {
  const auto components = static_cast<std::uint32_t>(std::max(7, std::atoi(count.c_str())));
  return run_assembly("product of " + count, stations(components), settings);
}

template <class Run>
bool run_assemblies(const Settings& settings, const Run& run) {
  std::printf("assembly\tcomponents\ttriangles\tout\t%s\tstaying\tclassify_s\tplan_s\taudit\tgood\n", kTierColumns);
  bool good = true;
  for (const std::string& name : settings.names) good = run(name, settings) && good;
  return good;
}

/// The group of cases to run, named by the first argument.
enum class Mode { None, Cases, Turned, Products, Files };

Mode parse(int argc, char** argv, Settings& settings) {
  static const std::map<std::string, Mode> kModes{
      {"cases", Mode::Cases}, {"turned", Mode::Turned}, {"products", Mode::Products}, {"files", Mode::Files}};
  bench::CommandLine line(
      "bench_plan cases [--shapes N] [--poses M] [--seed S] [--no-audit] [KIND...]\n"
      "       bench_plan turned [--poses M] [--seed S] [--from N] [--count N] [--no-audit] [ASSEMBLY...]\n"
      "       bench_plan products [--no-audit] [N...]\n"
      "       bench_plan files [--time-limit S] [--tolerance MM] [--target NAME] [--no-audit] ASSEMBLY...");
  bool no_audit = false;
  line.option("--shapes", settings.shapes, 1);
  line.option("--poses", settings.poses, 0);
  line.option("--seed", settings.seed, 0);
  line.option("--from", settings.from, 0);
  line.option("--count", settings.count, 1);
  line.option("--time-limit", settings.time_limit);
  line.option("--tolerance", settings.tolerance);
  line.option("--target", settings.target);
  line.flag("--no-audit", no_audit);
  line.words(settings.names);
  const auto mode = kModes.find(argc > 1 ? argv[1] : "");
  if (mode == kModes.end()) line.wrong();
  if (mode == kModes.end() || !line.parse(argc, argv, 2)) return Mode::None;
  if (no_audit) settings.audit = Audit::No;
  return mode->second;
}

bool run(Mode mode, const Settings& settings) {
  if (mode == Mode::Cases) return run_cases(settings);
  if (mode == Mode::Turned) return run_all_turned(settings);
  return run_assemblies(settings, mode == Mode::Files ? run_file : run_product);
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  using namespace dismantle;
  Settings settings;
  const Mode mode = parse(argc, argv, settings);
  if (mode == Mode::None) return bench::kExitUsage;
  return run(mode, settings) ? 0 : bench::kExitFailed;
}
