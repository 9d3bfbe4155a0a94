// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/option_checks.h"
#include "apps/cli/part_options.h"
#include "apps/cli/plan_text.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/instructions/precedence_drawing.h"
#include "dismantle/instructions/precedence_files.h"
#include "dismantle/planner/order/step_order.h"
#include "dismantle/planner/plan_allowing_overlaps.h"
#include "dismantle/planner/plan_path.h"
#include "dismantle/planner/step_margin.h"
#include "dismantle/planner/step_preference.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

struct PlanCommand {
  CommonOptions common;
  std::string output, graph;
  std::vector<std::string> targets, fixed;
  double time_limit = 0, effort = 1, allow_overlap = 0;
  std::vector<std::string> preferences;
  FastenerOrder fasteners = FastenerOrder::First;
  bool margins = false;
};

/// Accepts the name of a criterion, with a weight or without.
CLI::Validator preference() {
  std::vector<std::string> names;
  for (const auto& known : step_preferences()) names.push_back(known.first);
  const CLI::Validator is_name = one_of(std::move(names)), is_weight = above_zero();
  return CLI::Validator(
      [is_name, is_weight](std::string& text) {
        const std::size_t end = text.find('=');
        std::string name = text.substr(0, end), weight = end == std::string::npos ? "1" : text.substr(end + 1);
        const std::string error = is_name(name);
        return error.empty() ? is_weight(weight) : error;
      },
      "");
}

bool ends_with(const std::string& text, std::string_view ending) {
  return text.size() >= ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

Result<Done> check_graph(const std::string& file) {
  if (file.empty() || ends_with(file, ".svg") || ends_with(file, ".dot") || ends_with(file, ".json")) return Done{};
  return Error{ErrorKind::Usage,
               file + " cannot be written (its extension is not a known format); use .svg, .dot or .json"};
}

/// Writes the precedence graph of the steps. @return the number of ranks
Result<std::size_t> write_graph(const std::string& file, const Assembly& a, const PairStates& states, const Plan& plan,
                                const CommonOptions& common) {
  const ProgressCallback progress = progress_printer(common);
  const auto keep_going = [&] { return report_progress(progress, "finding the precedence of steps", -1); };
  const PrecedenceGraph graph = precedence_graph(a, states, plan, {make_executor(common), widest_lanes()}, keep_going);
  const auto text = ends_with(file, ".svg")   ? precedence_svg
                    : ends_with(file, ".dot") ? precedence_dot
                                              : precedence_json;
  if (const Result<Done> written = write_file(file, text(a, plan, graph)); !written) return written.error();
  const auto last = std::max_element(graph.ranks.begin(), graph.ranks.end());
  return last == graph.ranks.end() ? std::size_t{0} : std::size_t{*last} + 1;
}

Result<std::vector<ComponentId>> find_all(const Assembly& assembly, const std::vector<std::string>& names) {
  std::vector<ComponentId> found;
  for (const std::string& name : names) {
    const Result<ComponentId> id = find_component(assembly, name);
    if (!id) return id.error();
    found.push_back(*id);
  }
  return found;
}

/// ", margin 0.12 mm (to cover)"; empty where none was searched for.
std::string margin_text(const Assembly& a, const PlanStep& step) {
  if (!step.margin) return {};
  if (!step.margin->nearest.valid()) return fmt::format(", margin over {:.3g} mm", step.margin->margin);
  return fmt::format(", margin {:.3g} mm (to {})", step.margin->margin, a[step.margin->nearest].name);
}

void print_text(const PlanCommand& command, const Assembly& a, const Plan& plan) {
  for (std::size_t k = 0; k < plan.steps.size(); ++k) {
    const PlanStep& step = plan.steps[k];
    fmt::print("{:>4}  {}  {}, {}{}{}\n", k + 1, names_text(a, step.components), name_of(step.tier),
               direction_text(step.exit), fastener_text_of(a, step), margin_text(a, step));
  }
  fmt::print("{}{} steps in {:.2f} s:", plan.steps.empty() ? "" : "\n", plan.steps.size(), plan.seconds);
  for (const auto& [tier, count] : tier_counts(plan)) fmt::print(" {} {};", count, name_of(tier));
  std::size_t left = 0;
  for (const Explanation& e : plan.staying) left += e.group.size();
  fmt::print(" {}{}\n", plan.complete() ? "complete" : "incomplete",
             left == 0 ? "" : fmt::format(": {} component{}", left, left == 1 ? " remains" : "s remain"));
  for (const Explanation& e : plan.staying) fmt::print("  {}\n", explanation_text(a, e));
  if (plan.out_of_time) fmt::print("The search ended early; the path contains the steps found so far.\n");
  if (plan.effort_spent)
    fmt::print(
        "For some of these, sliding and sampled paths were searched for until the effort was spent; --effort {:g} "
        "searches longer.\n",
        std::max(1.0, 4 * command.effort));
  fmt::print("wrote {}\n", command.output);
}

/// The number of components that a plan takes out.
std::size_t removed_count(const Plan& plan) {
  std::set<ComponentId> removed;
  for (const PlanStep& step : plan.steps) removed.insert(step.components.begin(), step.components.end());
  return removed.size();
}

/// The least time limit of a plan, so that one without time left reports that it ran out of time [s].
constexpr double kLeastTime = 1e-3;
/// Share of a time limit that is kept for margins.
constexpr double kShareOfMargins = 0.2;

/// The remaining time of a limit that counts from the start of the command [s]; 0 if there is no limit.
double time_left(double limit, std::chrono::steady_clock::time_point begun) {
  if (limit == 0) return 0;
  return std::max(kLeastTime, limit - std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
}

Result<ExitCode> run(const PlanCommand& command) {
  const auto begun = std::chrono::steady_clock::now();
  if (const Result<Done> named = check_graph(command.graph); !named) return named.error();
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly.error();
  Result<PairStates> states = classify(*assembly, command.common);
  if (!states) return states.error();
  Result<PartChoices> choices = choose_parts(*assembly, *states, command.common);
  if (!choices) return choices.error();
  const Executor executor = make_executor(command.common);
  const Result<std::vector<ComponentId>> targets = find_all(*assembly, command.targets);
  if (!targets) return targets.error();
  const Result<std::vector<ComponentId>> fixed = find_all(*assembly, command.fixed);
  if (!fixed) return fixed.error();
  const std::vector<ComponentId> all_fixed = choices->groups.with_groups(*fixed);
  for (const ComponentId c : *targets)
    if (std::binary_search(all_fixed.begin(), all_fixed.end(), c))
      return Error{ErrorKind::Usage, "'" + (*assembly)[c].name +
                                         "' cannot be removed (it is both target and fixed); leave out one of the two"};

  PlanOptions options{*targets, *fixed, 0, {executor, widest_lanes()}, progress_printer(command.common)};
  options.search_longer(command.effort);
  const std::optional<ChosenPreferences> chosen = read_preferences(command.preferences);
  if (!chosen)
    return Error{ErrorKind::Usage, "--prefer cannot be followed (it names a criterion twice); name each once"};
  options.preferences = chosen->criteria;
  options.preference_weights = chosen->weights;
  options.fasteners = command.fasteners;
  options.flexible = choices->flexible;
  options.overlap_limit = command.allow_overlap > 0 ? command.allow_overlap : default_overlap_limit(*assembly);
  const auto planning = std::chrono::steady_clock::now();
  // Both plans below use what is prepared here.
  options.engine.keep_going = [&] {
    return command.time_limit == 0 || time_left(command.time_limit, begun) > kLeastTime;
  };
  options.engine.prepared = CertificateEngine(*assembly, *states, options.engine).surfaces();
  const auto make_plan = [&] {
    options.together = choices->groups.of_several();
    options.time_limit = time_left((command.margins ? 1 - kShareOfMargins : 1) * command.time_limit, begun);
    return command.allow_overlap > 0 ? plan_allowing_overlaps(*assembly, *states, options)
                                     : AllowingPlan{plan_disassembly(*assembly, *states, options), *states};
  };
  AllowingPlan found = make_plan();
  const PartChoices accepted = *choices;
  const Plan first = found.plan;
  const auto is_better = [&](const Plan& plan) { return removed_count(plan) > removed_count(found.plan); };
  if (command.allow_overlap == 0) options.wants_reasons = is_better;  // else more may come out thanks to reasons
  for (const bool whole : {false, true}) {
    if (found.plan.out_of_time || found.plan.staying.empty()) break;
    PartChoices less = accepted;
    if (!(whole ? take_back(less, first) : take_back_some(less, found.pairs, first))) continue;
    std::swap(*choices, less);
    AllowingPlan other = make_plan();
    if (is_better(other.plan)) {
      found = std::move(other);
    } else {
      *choices = std::move(less);
    }
  }
  if (command.margins)
    find_margins(
        *assembly, found.pairs, options.engine,
        [&](std::string_view stage, double share) {
          return options.engine.keep_going() && report_progress(options.progress, stage, share);
        },
        found.plan);
  found.plan.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - planning).count();
  const Plan& plan = found.plan;
  const Path path = plan_path(*assembly, found.pairs, plan);
  const Result<Done> written = write_path(command.output, path);
  if (!written) return written.error();
  if (!command.graph.empty()) {
    const Result<std::size_t> ranks = write_graph(command.graph, *assembly, found.pairs, plan, command.common);
    if (!ranks) return ranks.error();
    if (!command.common.json) fmt::print("wrote {}: {} ranks of steps\n", command.graph, *ranks);
  }
  if (command.common.json) {
    Json report = plan_json(*assembly, plan, path);
    report.update(choices_json(*assembly, *choices));
    report.update({{"path", command.output}, {"seconds", plan.seconds}});
    fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    fmt::print("{}", choices_text(*assembly, *choices));
    for (const ComponentPair& pair : found.pairs.pairs)
      if (const ComponentPair* before = states->find(pair.a, pair.b); pair.allowed_depth > before->allowed_depth)
        fmt::print("allowed: {} and {} may be {:.3g} mm deep in each other until they are apart ({:.2g} mm more)\n",
                   (*assembly)[pair.a].name, (*assembly)[pair.b].name, pair.allowed_depth,
                   pair.allowed_depth - before->allowed_depth);
    print_text(command, *assembly, plan);
  }
  return plan.complete() ? ExitCode::Done : ExitCode::No;
}

}  // namespace

void add_plan_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand(
      "plan", "Find a disassembly sequence, of the whole assembly or down to a component, and write its path");
  auto options = std::make_shared<PlanCommand>();
  add_assembly_argument(*command, options->common);
  command->add_option("-o,--output", options->output, "Path file to write (*.path.json)")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--target", options->targets, "Components to remove, with as few others as possible (default: all)")
      ->type_name("NAME");
  command->add_option("--fixed", options->fixed, "Components that never move (default: the largest component)")
      ->type_name("NAME");
  command
      ->add_option("--graph", options->graph,
                   "Also write the precedence graph of the steps: drawing (.svg), Graphviz (.dot), or JSON with "
                   "the tree of subassemblies (.json)")
      ->type_name("FILE");
  command
      ->add_option("--time-limit", options->time_limit,
                   "Time limit, from the start of the command; keeps what was found")
      ->type_name("S")
      ->check(above_zero());
  command->add_flag("--margins", options->margins,
                    "For each step, by how much all surfaces could grow before it would not be free: half the smallest "
                    "distance to what the moving components do not touch in the assembled state");
  const OrderWeights usual;
  command
      ->add_option("--prefer", options->preferences,
                   fmt::format("What makes an order of steps good: few changes of direction, little turning over (z is "
                               "up), equal components in a row, nothing left unsupported, few changes of tool, nothing "
                               "left loose; the first counts most, or each by its weight (default: direction={} "
                               "upright={} groups={} tools={} loose={})",
                               usual.direction, usual.upright, usual.groups, usual.tools, usual.loose))
      ->check(preference())
      ->type_name("direction|upright|groups|support|tools|loose[=WEIGHT]");
  command
      ->add_option(
          "--fasteners", options->fasteners,
          "Order of screws and nuts: first, before what they hold, unscrewed along their axes, wherever that is "
          "possible; or as any other component (default: first)")
      ->transform(choice(
          std::map<std::string, FastenerOrder>{{"first", FastenerOrder::First}, {"any", FastenerOrder::Ignored}}))
      ->type_name("first|any");
  command
      ->add_option("--allow-overlap", options->allow_overlap,
                   "Where a component stays otherwise, let it overlap what it touches by up to this much more than in "
                   "the assembled state until they are apart; the path says which pairs, and by how much")
      ->type_name("MM")
      ->check(above_zero());
  command
      ->add_option("--effort", options->effort,
                   "Effort of the search for paths that are not straight, as a factor (default: 1, some seconds)")
      ->type_name("TIMES")
      ->check(between(0.0, 1e6));
  add_allow_option(*command, options->common);
  add_flexible_option(*command, options->common);
  add_together_option(*command, options->common);
  add_common_options(*command, options->common);
  command->footer("Exit code 0: all targets can be removed; 1: not all, with the reasons.");
  command->callback([options, &exit_code] {
    const Result<ExitCode> result = run(*options);
    exit_code = result ? *result : report(result.error());
  });
}

}  // namespace dismantle::cli
