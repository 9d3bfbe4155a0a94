// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/cli/command.h"

namespace dismantle::cli {

// In the order of the help text. Each declares one subcommand and puts its result into `exit_code`.
void add_info_command(CLI::App& app, ExitCode& exit_code);
void add_check_command(CLI::App& app, ExitCode& exit_code);
void add_convert_command(CLI::App& app, ExitCode& exit_code);
void add_audit_command(CLI::App& app, ExitCode& exit_code);
void add_simplify_command(CLI::App& app, ExitCode& exit_code);
void add_render_command(CLI::App& app, ExitCode& exit_code);
void add_move_command(CLI::App& app, ExitCode& exit_code);
void add_plan_command(CLI::App& app, ExitCode& exit_code);
void add_why_command(CLI::App& app, ExitCode& exit_code);
void add_export_command(CLI::App& app, ExitCode& exit_code);
void add_batch_command(CLI::App& app, ExitCode& exit_code);
void add_sample_command(CLI::App& app, ExitCode& exit_code);
void add_view_command(CLI::App& app, ExitCode& exit_code);

}  // namespace dismantle::cli
