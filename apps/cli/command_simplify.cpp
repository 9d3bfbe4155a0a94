// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/option_checks.h"
#include "dismantle/files/number_text.h"
#include "dismantle/loading/write_assembly.h"
#include "dismantle/simplify/simplify_assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

struct SimplifyCommand {
  CommonOptions common;
  std::size_t triangles = 0;
  std::string output;
};

Result<SimplifiedAssembly> run(const SimplifyCommand& command) {
  const Executor executor = make_executor(command.common);
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return assembly.error();
  SimplifyOptions options;
  options.executor = executor;
  options.progress = progress_printer(command.common);
  Result<SimplifiedAssembly> simplified = simplify_assembly(*assembly, command.triangles, options);
  if (!simplified) return simplified;
  const Result<Done> written = write_assembly(command.output, simplified->assembly);
  if (!written) return written.error();
  return simplified;
}

std::size_t count_before(const SimplifiedAssembly& simplified) {
  std::size_t count = 0;
  for (const ComponentSimplification& c : simplified.components) count += c.triangles_before;
  return count;
}

void print_text(const SimplifiedAssembly& simplified, const std::string& output) {
  const Assembly& assembly = simplified.assembly;
  fmt::print("{}: {} triangles, of {} before; largest deviation of a surface {} mm\n\n", output,
             triangle_count(assembly), count_before(simplified), number_text(assembly.simplification_error, 4));
  std::size_t width = 9;
  for (const Component& c : assembly.components) width = std::max(width, c.name.size());
  fmt::print("{:<{}}  {:>9}  {:>9}  {:>9}\n", "component", width, "before", "after", "error mm");
  for (std::size_t i = 0; i < assembly.components.size(); ++i) {
    const ComponentSimplification& c = simplified.components[i];
    fmt::print("{:<{}}  {:>9}  {:>9}  {:>9}\n", assembly.components[i].name, width, c.triangles_before,
               c.triangles_after, number_text(c.error.upper, 4));
  }
}

void print_json(const SimplifiedAssembly& simplified, const std::string& output) {
  Json components = Json::array();
  for (std::size_t i = 0; i < simplified.components.size(); ++i) {
    const ComponentSimplification& c = simplified.components[i];
    components.push_back({{"name", simplified.assembly.components[i].name},
                          {"triangles_before", c.triangles_before},
                          {"triangles", c.triangles_after},
                          {"error_mm", c.error.upper}});
  }
  const Json report{{"format", "dismantle-simplify"},
                    {"version", 1},
                    {"file", output},
                    {"triangles_before", count_before(simplified)},
                    {"triangles", triangle_count(simplified.assembly)},
                    {"error_mm", simplified.assembly.simplification_error},
                    {"components", components}};
  fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

void add_simplify_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command =
      app.add_subcommand("simplify", "Reduce the number of triangles of each component, with a measured error bound");
  auto options = std::make_shared<SimplifyCommand>();
  add_assembly_argument(*command, options->common);
  command->add_option("--triangles", options->triangles, "Approximate number of triangles of the result")
      ->required()
      ->type_name("N")
      ->check(above_zero());
  command->add_option("-o,--output", options->output, "File or folder to write, as for 'convert'")
      ->required()
      ->type_name("FILE");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    const Result<SimplifiedAssembly> simplified = run(*options);
    if (!simplified) {
      exit_code = report(simplified.error());
    } else if (options->common.json) {
      print_json(*simplified, options->output);
    } else {
      print_text(*simplified, options->output);
    }
  });
}

}  // namespace dismantle::cli
