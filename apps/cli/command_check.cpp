// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/option_checks.h"
#include "apps/cli/part_options.h"
#include "dismantle/documents/check_report.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/report/html_check_report.h"

#include <fmt/format.h>

#include <memory>

namespace dismantle::cli {

namespace {

struct CheckCommand {
  CommonOptions common;
  double clearance = 0;
  std::string html_file;
  std::size_t pictures = HtmlCheckOptions{}.pictures;
};

Result<Done> write_html(const Assembly& assembly, const Clashes& clashes, const CheckCommand& command) {
  const Executor executor = make_executor(command.common);
  HtmlCheckOptions options;
  options.pictures = command.pictures;
  options.executor = executor;
  options.progress = progress_printer(command.common);
  const Result<std::string> html = html_check_report(assembly, clashes, options);
  if (!html) return html.error();
  return write_file(command.html_file, *html);
}

Result<Done> run(const CheckCommand& command) {
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly.error();
  Result<Clashes> clashes = clashes_of(*assembly, command.common, command.clearance);
  if (!clashes) return clashes.error();
  PairStates states = pair_states(*clashes, command.common.pairs);
  const Result<PartChoices> choices = choose_parts(*assembly, states, command.common);
  if (!choices) return choices.error();
  std::erase_if(clashes->pairs, [&](const Clash& pair) { return choices->groups.together(pair.a, pair.b); });
  if (!command.html_file.empty()) {
    const Result<Done> written = write_html(*assembly, *clashes, command);
    if (!written) return written.error();
  }
  if (command.common.json) {
    fmt::print("{}", check_report_json(*assembly, *clashes));
  } else {
    fmt::print("{}", choices_text(*assembly, *choices));
    fmt::print("{}", check_report_text(*assembly, *clashes));
    if (!command.html_file.empty()) fmt::print("\nReport with pictures: {}\n", command.html_file);
  }
  return Done{};
}

}  // namespace

void add_check_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command =
      app.add_subcommand("check", "List the pairs of components that touch or overlap, with depth, place and volume");
  auto options = std::make_shared<CheckCommand>();
  add_assembly_argument(*command, options->common);
  command->add_option("--clearance", options->clearance, "Also list pairs that are apart by at most this")
      ->type_name("MM")
      ->check(not_negative());
  command->add_option("--html", options->html_file, "Also write the report as one HTML page with pictures")
      ->type_name("FILE");
  command->add_option("--pictures", options->pictures, "Maximum number of pictures of single overlaps in the HTML page")
      ->type_name("N")
      ->capture_default_str();
  add_together_option(*command, options->common);
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    const Result<Done> done = run(*options);
    if (!done) exit_code = report(done.error());
  });
}

}  // namespace dismantle::cli
