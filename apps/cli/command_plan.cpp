// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/plan_text.h"
#include "dismantle/io/path_file.h"
#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/plan_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

struct PlanCommand {
  CommonOptions common;
  std::string output;
  std::vector<std::string> targets, fixed;
  double time_limit = 0;
};

Result<std::vector<ComponentId>> find_all(const Assembly& assembly, const std::vector<std::string>& names) {
  std::vector<ComponentId> found;
  for (const std::string& name : names) {
    const Result<ComponentId> id = find_component(assembly, name);
    if (!id) return id.error();
    found.push_back(*id);
  }
  return found;
}

/// How many components each tier took out by themselves, and how many bodies of several.
std::map<PlanTier, std::size_t> tier_counts(const Plan& plan) {
  std::map<PlanTier, std::size_t> counts;
  for (const PlanStep& step : plan.steps) ++counts[step.tier];
  return counts;
}

Json to_json(const PlanCommand& command, const Assembly& a, const Plan& plan, const Path& path) {
  Json steps = Json::array(), staying = Json::array(), tiers = Json::object();
  for (const PlanStep& step : plan.steps)
    steps.push_back({{"components", names_json(a, step.components)},
                     {"tier", name_of(step.tier)},
                     {"part_of_step", step.part_of == PlanStep::kWhole ? Json(nullptr) : Json(step.part_of)},
                     {"exit", {step.exit.x, step.exit.y, step.exit.z}}});
  for (const Explanation& e : plan.staying) staying.push_back(explanation_json(a, e));
  for (const auto& [tier, count] : tier_counts(plan)) tiers[std::string(name_of(tier))] = count;
  return {{"format", "dismantle-plan"},
          {"version", 1},
          {"assembly", {{"file", a.source_file}, {"components", a.components.size()}}},
          {"path", command.output},
          {"complete", plan.complete()},
          {"out_of_time", plan.out_of_time},
          {"seconds", plan.seconds},
          {"tiers", tiers},
          {"steps", steps},
          {"staying", staying},
          {"removed", path.removed}};
}

void print_text(const PlanCommand& command, const Assembly& a, const Plan& plan) {
  for (std::size_t k = 0; k < plan.steps.size(); ++k) {
    const PlanStep& step = plan.steps[k];
    fmt::print("{:>4}  {}  {}, {}\n", k + 1, names_text(a, step.components), name_of(step.tier),
               direction_text(step.exit));
  }
  fmt::print("{}{} steps in {:.2f} s:", plan.steps.empty() ? "" : "\n", plan.steps.size(), plan.seconds);
  for (const auto& [tier, count] : tier_counts(plan)) fmt::print(" {} {};", count, name_of(tier));
  fmt::print(" {}\n", plan.complete() ? "all that was asked for comes out" : "not all comes out");
  for (const Explanation& e : plan.staying) fmt::print("  {}\n", explanation_text(a, e));
  if (plan.out_of_time) fmt::print("The search was ended early; what it found until then is in the path.\n");
  fmt::print("wrote {}\n", command.output);
}

Result<ExitCode> run(const PlanCommand& command) {
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly.error();
  const Result<PairStates> states = classify(*assembly, command.common);
  if (!states) return states.error();
  const Executor executor = make_executor(command.common);
  const Result<std::vector<ComponentId>> targets = find_all(*assembly, command.targets);
  if (!targets) return targets.error();
  const Result<std::vector<ComponentId>> fixed = find_all(*assembly, command.fixed);
  if (!fixed) return fixed.error();
  for (const ComponentId c : *targets)
    if (std::find(fixed->begin(), fixed->end(), c) != fixed->end())
      return Error{ErrorKind::Usage, "'" + (*assembly)[c].name +
                                         "' cannot come out (it is a target, and fixed); leave out one of the two"};

  const Plan plan = plan_disassembly(
      *assembly, *states,
      {*targets, *fixed, command.time_limit, {executor, widest_lanes()}, progress_printer(command.common)});
  const Path path = plan_path(*assembly, *states, plan);
  const Result<Done> written = write_path(command.output, path);
  if (!written) return written.error();
  if (command.common.json) {
    fmt::print("{}\n", to_json(command, *assembly, plan, path).dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_text(command, *assembly, plan);
  }
  return plan.complete() ? ExitCode::Done : ExitCode::No;
}

}  // namespace

void add_plan_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand(
      "plan", "Find how the assembly comes apart, or how to get a component out, and write the path");
  auto options = std::make_shared<PlanCommand>();
  add_assembly_argument(*command, options->common);
  command->add_option("-o,--output", options->output, "The path to write (*.path.json)")->required();
  command->add_option("--target", options->targets, "Take these out, and as few others as possible (default: all)")
      ->type_name("NAME");
  command->add_option("--fixed", options->fixed, "These never move (default: the largest component)")
      ->type_name("NAME");
  command->add_option("--time-limit", options->time_limit, "End the search after so long, with what it has found")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  add_common_options(*command, options->common);
  command->footer("Exit code 0: all that was asked for comes out; 1: not all, and why.");
  command->callback([options, &exit_code] {
    const Result<ExitCode> result = run(*options);
    exit_code = result ? *result : report(result.error());
  });
}

}  // namespace dismantle::cli
