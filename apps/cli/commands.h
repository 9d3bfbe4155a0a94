// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/cli/command.h"

namespace dismantle::cli {

// Each function declares one subcommand of `app`, whose callback sets `exit_code`; both must outlive the parse. In the
// order of the help text.

/// Adds `info`, which lists components, triangles, units and mesh faults.
void add_info_command(CLI::App& app, ExitCode& exit_code);
/// Adds `check`, which lists contacts, fits and overlaps in the assembled state.
void add_check_command(CLI::App& app, ExitCode& exit_code);
/// Adds `convert`, which writes the assembly as meshes.
void add_convert_command(CLI::App& app, ExitCode& exit_code);
/// Adds `audit`, which checks a path independently of the planner and the engine.
void add_audit_command(CLI::App& app, ExitCode& exit_code);
/// Adds `simplify`, which reduces the number of triangles.
void add_simplify_command(CLI::App& app, ExitCode& exit_code);
/// Adds `render`, which renders a picture.
void add_render_command(CLI::App& app, ExitCode& exit_code);
/// Adds `move`, which plays a motion with collision handling and writes the path.
void add_move_command(CLI::App& app, ExitCode& exit_code);
/// Adds `plan`, which finds a disassembly sequence and writes its path.
void add_plan_command(CLI::App& app, ExitCode& exit_code);
/// Adds `why`, which names the blockers of a component.
void add_why_command(CLI::App& app, ExitCode& exit_code);
/// Adds `export`, which writes animations, pages, pictures, tables and work instructions.
void add_export_command(CLI::App& app, ExitCode& exit_code);
/// Adds `batch`, which checks and plans all assemblies below a folder.
void add_batch_command(CLI::App& app, ExitCode& exit_code);
/// Adds `sample`, which writes a bundled sample.
void add_sample_command(CLI::App& app, ExitCode& exit_code);
/// Adds `view`, which serves the viewer.
void add_view_command(CLI::App& app, ExitCode& exit_code);

}  // namespace dismantle::cli
