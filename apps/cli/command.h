// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/clash.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/result.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/exec/executor.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/streams/choose_streams_backend.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// Declarations that the commands share. A command is one file, command_<name>.cpp, with one function
/// add_<name>_command(app, exit_code) that declares its options and sets the callback; main.cpp lists them.
namespace dismantle::cli {

/// Exit codes of the program (docs/cli.md).
enum class ExitCode {
  Done = 0,
  No = 1,     ///< The command ran, and its result is negative: violations, an incomplete plan, a blocked component.
  Usage = 2,  ///< Wrong arguments.
  Unreadable = 3,  ///< The input cannot be read.
  Failed = 4,      ///< Anything else: cancelled, out of memory, the output cannot be written.
};

/// The options that all commands have in common.
struct CommonOptions {
  std::string assembly_file;                 ///< The argument ASSEMBLY.
  ImportOptions import;                      ///< --units, --deflection, --angular-deflection.
  double tolerance = 0;                      ///< [mm]; 0: default.
  ClassifyRule pairs = ClassifyRule::Auto;   ///< What overlapping pairs may do.
  std::vector<DeclaredAllowance> allowed;    ///< --allow.
  std::vector<std::string> together;         ///< --together.
  std::vector<std::string> flexible;         ///< --flexible.
  bool accept_proposals = false;             ///< --accept-proposals.
  bool no_proposals = false;                 ///< --no-proposals.
  std::size_t simplify = 0;                  ///< Approximate number of triangles; 0: no simplification.
  DeviceChoice device = DeviceChoice::Auto;  ///< --device.
  bool uses_device = false;                  ///< The command can use a device; otherwise it computes on the CPU.
  int threads = 0;                           ///< 0: all cores.
  bool json = false;                         ///< Print the result as JSON.
  bool quiet = false;                        ///< Do not print progress.
};

/// Declares the common options on a command. `options` must outlive the parse.
void add_common_options(CLI::App& command, CommonOptions& options);
/// Declares --allow, for commands that move components.
void add_allow_option(CLI::App& command, CommonOptions& options);
/// The largest additional overlap that explanations search for [mm]: 1% of the diagonal, at most 0.5 mm.
double default_overlap_limit(const Assembly& assembly);
/// Declares the positional ASSEMBLY argument.
void add_assembly_argument(CLI::App& command, CommonOptions& options);

/// True if the file name is that of a path: *.path.json.
bool is_path_file(const std::string& file);
/// The assembly file of a path, in the folder of the path file. Errors: Unreadable if it is not there.
Result<std::filesystem::path> assembly_beside(const std::string& path_file, const Path& path);

/// Prints a note on stderr if the path was made for another version of the assembly.
void note_other_version(const Path& path, const Assembly& assembly);

/// Prints progress on one line of stderr if that is a terminal and --quiet is not given, and cancels at Ctrl+C.
/// Installs the handler of SIGINT.
ProgressCallback progress_printer(const CommonOptions& options);

/// Prints a note on stderr that the CPU is used, with the reason, if --device cuda was given.
void note_cpu(const CommonOptions& options, const std::string& why);

/// The executor for --threads.
Executor make_executor(const CommonOptions& options);

/// Loads the assembly; simplifies it if --simplify is given. Errors: of load_assembly and simplify_assembly.
Result<Assembly> load(const CommonOptions& options);

/// Classifies the pairs with --tolerance, --pairs and --allow. Pairs within `clearance` [mm] are near. Errors: of
/// classify_pairs.
Result<PairStates> classify(const Assembly& assembly, const CommonOptions& options, double clearance = 0);

/// Finds the clashes with --tolerance. Pairs within `clearance` [mm] are near. Errors: of find_clashes.
Result<Clashes> clashes_of(const Assembly& assembly, const CommonOptions& options, double clearance);

/// Makes report() also print errors as one JSON object on stdout (docs/formats.md), for --json.
void report_errors_as_json();

/// Prints "dismantle: <message>" on stderr. @return the exit code for the error's kind
ExitCode report(const Error& error);

}  // namespace dismantle::cli
