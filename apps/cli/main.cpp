// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/usage_error.h"
#include "dismantle/exec/cuda_device.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  using namespace dismantle::cli;
  CLI::App app{
      "dismantle: virtual disassembly of CAD assemblies, with continuous collision handling.\n"
      "Lengths are millimetres, angles radians. 'dismantle COMMAND --help' lists the options of a command.",
      "dismantle"};
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.get_formatter()->label("Subcommands", "Commands");
  app.set_version_flag("--version", "dismantle " DISMANTLE_VERSION);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done, 1 negative result, 2 wrong usage, 3 unreadable input, 4 failed.");

  ExitCode exit_code = ExitCode::Done;
  add_info_command(app, exit_code);
  add_check_command(app, exit_code);
  add_convert_command(app, exit_code);
  add_audit_command(app, exit_code);
  add_simplify_command(app, exit_code);
  add_render_command(app, exit_code);
  add_move_command(app, exit_code);
  add_plan_command(app, exit_code);
  add_why_command(app, exit_code);
  add_export_command(app, exit_code);
  add_batch_command(app, exit_code);
  add_sample_command(app, exit_code);
  add_view_command(app, exit_code);

  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  if (arguments.empty()) {
    std::fputs(app.help().c_str(), stderr);
    return static_cast<int>(ExitCode::Usage);
  }
  if (std::find(arguments.begin(), arguments.end(), "--json") != arguments.end()) report_errors_as_json();
  if (const std::optional<dismantle::Error> unknown = unknown_command(app, arguments))
    return static_cast<int>(report(*unknown));

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(report(usage_error(app, error, arguments)));
  } catch (const std::bad_alloc&) {
    return static_cast<int>(report({dismantle::ErrorKind::Failed,
                                    "out of memory (the assembly is too large for this machine); try --simplify N"}));
  } catch (const dismantle::CudaError& error) {
    return static_cast<int>(report({dismantle::ErrorKind::Failed,
                                    std::string("the CUDA device failed (") + error.what() + "); try --device cpu"}));
  } catch (const std::exception& error) {
    return static_cast<int>(report({dismantle::ErrorKind::Failed, std::string("internal failure (") + error.what() +
                                                                      "); please report it with the command line"}));
  }
  return static_cast<int>(exit_code);
}
