// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/part_options.h"
#include "apps/cli/plan_text.h"
#include "dismantle/assembly/rigid_groups.h"
#include "dismantle/planner/plan_disassembly.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

struct WhyCommand {
  CommonOptions common;
  std::string component;
};

Result<ExitCode> run(const WhyCommand& command) {
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly.error();
  const Result<ComponentId> component = find_component(*assembly, command.component);
  if (!component) return component.error();
  Result<PairStates> states = classify(*assembly, command.common);
  if (!states) return states.error();
  const Executor executor = make_executor(command.common);

  const Result<PartChoices> choices = choose_parts(*assembly, *states, command.common);
  if (!choices) return choices.error();

  PlanOptions options;
  options.engine = {executor, widest_lanes()};
  options.progress = progress_printer(command.common);
  options.together = choices->groups.of_several();
  options.flexible = choices->flexible;
  options.overlap_limit = default_overlap_limit(*assembly);
  const Explanation why = why_blocked(*assembly, *states, *component, options);
  if (command.common.json) {
    Json report{{"format", "dismantle-why"}, {"version", 1}};
    report.update(explanation_json(*assembly, why));
    fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    fmt::print("{}\n", explanation_text(*assembly, why));
  }
  return why.blockers.empty() ? ExitCode::Done : ExitCode::No;
}

}  // namespace

void add_why_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand("why", "Explain what blocks the straight removal of a component");
  auto options = std::make_shared<WhyCommand>();
  add_assembly_argument(*command, options->common);
  command->add_option("COMPONENT", options->component, "Name of the component, as in 'dismantle info'")->required();
  add_allow_option(*command, options->common);
  add_flexible_option(*command, options->common);
  add_together_option(*command, options->common);
  add_common_options(*command, options->common);
  command->footer("Exit code 0: nothing, it can be removed; 1: blocked, as printed.");
  command->callback([options, &exit_code] {
    const Result<ExitCode> result = run(*options);
    exit_code = result ? *result : report(result.error());
  });
}

}  // namespace dismantle::cli
