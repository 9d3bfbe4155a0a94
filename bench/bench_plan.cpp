// SPDX-License-Identifier: Apache-2.0
// What the planner takes apart, by which tier, in what time; every path audited.
//   bench_plan cases [--shapes N] [--poses M] [--seed S] [KIND...]   N shapes of each kind of generated case, each as
//   it
//                                                         is and in M random orientations, scales and tessellations
//   bench_plan turned [--poses M] [--seed S] [--from N] [--count N] [ASSEMBLY...]   whether the same comes out of the
//                                                         assembly in M random orientations, scales and tessellations:
//                                                         of these assemblies, or else of 200 generated ones of two
//                                                         components; --from and --count take a part of them
//   bench_plan products [N...]                            generated products of about N components
//   bench_plan files [--time-limit S] [--tolerance MM] [--target NAME] ASSEMBLY...
//                                                         assemblies, or only one component out of them
// --no-audit: plans only. One row a case or an assembly, tab-separated. `good`: exactly what is known to come out does,
// and the audit holds; for assemblies: all comes out or is explained, and the audit holds. Times, the limit's too, are
// processor times of one thread and do not include reading.
#include "dismantle/audit/audit_path.h"
#include "dismantle/io/load_assembly.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"
#include "tests/support/disassembly_cases.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <set>
#include <string>

namespace dismantle {
namespace {

using namespace scenes;

/// Processor time, which other programs do not change much [s].
double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

/// So many generated cases of two components there are to be turned.
constexpr std::size_t kTurnedCases = 200;

/// What was planned, and what it cost.
struct Planned {
  Plan plan;
  bool audited = false;
  double classify_seconds = 0, plan_seconds = 0;
};

enum class Audited { Yes, No };

Planned plan_and_audit(const Assembly& assembly, double tolerance, const PlanOptions& options, Audited audited) {
  Planned planned;
  const double start = processor_seconds();
  ClassifyOptions classify;
  classify.tolerance = tolerance;
  const PairStates pairs = classify_pairs(assembly, classify).value();
  const double classified = processor_seconds();
  planned.classify_seconds = classified - start;
  planned.plan = plan_disassembly(assembly, pairs, options);
  const Path path = plan_path(assembly, pairs, planned.plan);
  planned.plan_seconds = processor_seconds() - classified;
  planned.audited = audited == Audited::No || audit_path(assembly, path).holds();
  return planned;
}

/// The components that some step takes out by themselves.
std::size_t taken_out(const Plan& plan) {
  return static_cast<std::size_t>(std::count_if(plan.steps.begin(), plan.steps.end(),
                                                [](const PlanStep& step) { return step.components.size() == 1; }));
}

/// How many steps each tier made: as a row has it.
std::string tiers(const Plan& plan) {
  std::string row;
  for (const PlanTier tier : {PlanTier::Straight, PlanTier::Helical, PlanTier::Sliding, PlanTier::StraightTogether})
    row += '\t' + std::to_string(std::count_if(plan.steps.begin(), plan.steps.end(),
                                               [tier](const PlanStep& step) { return step.tier == tier; }));
  return row;
}

constexpr const char* kTierColumns = "straight\thelical\tsliding\ttogether";

/// What came of all the cases of one kind.
struct Tally {
  std::size_t plans = 0, good = 0, false_free = 0;
  std::vector<double> ms;
};

struct Settings {
  int shapes = 3, poses = 1;
  std::uint64_t seed = 1;
  std::size_t from = 0, count = kTurnedCases;
  Audited audited = Audited::Yes;
  double time_limit = 60, tolerance = 0;
  std::string target;
  std::vector<std::string> names;
};

void run_case(CaseKind kind, int shape, const DisassemblyCase& made, double scale, Audited audited, Tally& tally) {
  PlanOptions options;
  for (std::uint32_t c = 0; c < made.fixed; ++c) options.fixed.emplace_back(c);
  const std::size_t others = made.assembly.components.size() - made.fixed;
  const Planned planned = plan_and_audit(made.assembly, 0.01 * scale, options, audited);
  const std::size_t out = taken_out(planned.plan);
  const bool good = out == (comes_apart(kind) ? others : 0) && planned.audited;
  ++tally.plans;
  tally.good += good;
  tally.false_free += !comes_apart(kind) && out > 0;
  tally.ms.push_back(1e3 * planned.plan_seconds);
  std::printf("%s\t%d\t%g\t%zu\t%zu%s\t%.1f\t%.1f\t%s\t%s\n", std::string(name_of(kind)).c_str(), shape, scale, others,
              out, tiers(planned.plan).c_str(), 1e3 * planned.classify_seconds, 1e3 * planned.plan_seconds,
              planned.audited ? "holds" : "BROKEN", good ? "yes" : "NO");
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
      run_case(kind, shape, made, 1, settings.audited, tally);
      for (int pose = 0; pose < settings.poses; ++pose) {
        const double scale = std::array{0.01, 1.0, 1000.0}[static_cast<std::size_t>(pose) % 3];
        const Pose turned = random_pose(random, 50, 3);
        run_case(kind, shape, {placed(refined(made.assembly, random), turned, scale), made.fixed}, scale,
                 settings.audited, tally);
      }
    }
    all_good = all_good && tally.good == tally.plans;
    tallies.emplace_back(kind, std::move(tally));
  }
  std::printf("\nkind\tplans\tgood\tfalse free\tmedian_ms\tp99_ms\tmost_ms\n");
  for (const auto& [kind, tally] : tallies)
    std::printf("%s\t%zu\t%zu\t%zu\t%.1f\t%.1f\t%.1f\n", std::string(name_of(kind)).c_str(), tally.plans, tally.good,
                tally.false_free, quantile(tally.ms, 0.5), quantile(tally.ms, 0.99), quantile(tally.ms, 1));
  return all_good;
}

bool run_assembly(const Assembly& assembly, const Settings& settings) {
  PlanOptions options;
  for (std::uint32_t c = 0; c < assembly.components.size(); ++c)
    if (assembly.components[c].name == settings.target) options.targets.emplace_back(c);
  const double end = processor_seconds() + settings.time_limit;
  options.progress = [end](std::string_view, double) { return processor_seconds() < end; };
  const Planned planned = plan_and_audit(assembly, settings.tolerance, options, settings.audited);
  const bool good = planned.audited && !planned.plan.out_of_time;
  std::printf("%s\t%zu\t%zu\t%zu%s\t%zu\t%.2f\t%.2f\t%s\t%s\n", assembly.source_file.c_str(),
              assembly.components.size(), triangle_count(assembly), taken_out(planned.plan),
              tiers(planned.plan).c_str(), planned.plan.staying.size(), planned.classify_seconds, planned.plan_seconds,
              planned.audited ? "holds" : "BROKEN", good ? "yes" : "NO");
  std::fflush(stdout);
  return good;
}

/// What some step takes out by itself, by name.
std::set<std::string> removed(const Assembly& assembly, const Plan& plan) {
  std::set<std::string> names;
  for (const PlanStep& step : plan.steps)
    if (step.components.size() == 1) names.insert(assembly[step.components[0]].name);
  return names;
}

/// Whether the same comes out of an assembly however it is turned, in other sizes and of more triangles. It says so as
/// it goes on: such a run is long.
/// @param tolerance of the assembly as it is [mm]; 0: the planner's own
bool run_turned(const std::string& name, const Assembly& assembly, double tolerance, const Settings& settings) {
  std::mt19937_64 random(settings.seed);
  std::set<std::string> expected;
  int same = 0;
  double seconds = 0;
  bool audited = true;
  for (int pose = 0; pose <= settings.poses; ++pose) {
    const double scale = pose == 0 ? 1 : std::array{0.01, 1.0, 1000.0}[static_cast<std::size_t>(pose) % 3];
    Assembly other = assembly;
    if (pose > 0) {
      const Pose turned = random_pose(random, 50, 3);
      other = placed(refined(assembly, random), turned, scale);
    }
    const Planned planned = plan_and_audit(other, tolerance * scale, {}, settings.audited);
    seconds += planned.classify_seconds + planned.plan_seconds;
    audited = audited && planned.audited;
    const std::set<std::string> out = removed(other, planned.plan);
    if (pose == 0) expected = out;
    same += pose > 0 && out == expected;
    if (out != expected) std::fprintf(stderr, "%s: other components at pose %d, scale %g\n", name.c_str(), pose, scale);
  }
  const bool good = same == settings.poses && audited;
  std::printf("%s\t%zu\t%zu\t%d\t%d\t%.2f\t%s\t%s\n", name.c_str(), assembly.components.size(), expected.size(),
              settings.poses, same, seconds, audited ? "holds" : "BROKEN", good ? "yes" : "NO");
  std::fflush(stdout);
  return good;
}

/// The generated case of two components of this index, always the same.
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
  std::printf("case\tcomponents\tout\tposes\tsame\tseconds\taudit\tgood\n");
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
    if (!assembly) std::fprintf(stderr, "%s\n", assembly.error().message.c_str());
    good += assembly && run_turned(file, *assembly, settings.tolerance, settings);
  }
  std::printf("\n%zu of %zu cases good\n", good, done);
  return good == done;
}

bool run_file(const std::string& file, const Settings& settings) {
  const Result<Assembly> assembly = load_assembly(file);
  if (assembly) return run_assembly(*assembly, settings);
  std::fprintf(stderr, "%s\n", assembly.error().message.c_str());
  return false;
}

bool run_product(const std::string& count, const Settings& settings) {
  Assembly product = stations(static_cast<std::uint32_t>(std::max(7, std::atoi(count.c_str()))));
  product.source_file = "product";
  return run_assembly(product, settings);
}

template <class Run>
bool run_assemblies(const Settings& settings, const Run& run) {
  std::printf("assembly\tcomponents\ttriangles\tout\t%s\tstaying\tclassify_s\tplan_s\taudit\tgood\n", kTierColumns);
  bool good = true;
  for (const std::string& name : settings.names) good = run(name, settings) && good;
  return good;
}

bool parse(int argc, char** argv, Settings& settings) {
  for (int i = 2; i < argc; ++i) {
    const std::string option = argv[i];
    const bool has_value = i + 1 < argc;
    if (option == "--shapes" && has_value) {
      settings.shapes = std::atoi(argv[++i]);
    } else if (option == "--poses" && has_value) {
      settings.poses = std::atoi(argv[++i]);
    } else if (option == "--seed" && has_value) {
      settings.seed = static_cast<std::uint64_t>(std::atoll(argv[++i]));
    } else if (option == "--from" && has_value) {
      settings.from = static_cast<std::size_t>(std::atoll(argv[++i]));
    } else if (option == "--count" && has_value) {
      settings.count = static_cast<std::size_t>(std::atoll(argv[++i]));
    } else if (option == "--no-audit") {
      settings.audited = Audited::No;
    } else if (option == "--time-limit" && has_value) {
      settings.time_limit = std::atof(argv[++i]);
    } else if (option == "--target" && has_value) {
      settings.target = argv[++i];
    } else if (option == "--tolerance" && has_value) {
      settings.tolerance = std::atof(argv[++i]);
    } else if (option.rfind("--", 0) == 0) {
      return false;
    } else {
      settings.names.push_back(option);
    }
  }
  return true;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  using namespace dismantle;
  const std::string what = argc > 1 ? argv[1] : "";
  Settings settings;
  if ((what != "cases" && what != "turned" && what != "files" && what != "products") || !parse(argc, argv, settings)) {
    std::fprintf(
        stderr,
        "usage: bench_plan cases [--shapes N] [--poses M] [--seed S] [--no-audit] [KIND...]\n"
        "       bench_plan turned [--poses M] [--seed S] [--from N] [--count N] [--no-audit] [ASSEMBLY...]\n"
        "       bench_plan products [N...]\n"
        "       bench_plan files [--time-limit S] [--tolerance MM] [--target NAME] [--no-audit] ASSEMBLY...\n");
    return 2;
  }
  if (what == "cases") return run_cases(settings) ? 0 : 1;
  if (what == "turned") return run_all_turned(settings) ? 0 : 1;
  return run_assemblies(settings, what == "files" ? run_file : run_product) ? 0 : 1;
}
