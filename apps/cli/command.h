// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
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

/// Declarations that the commands share. A command is one file, command_<name>.cpp, with one function
/// add_<name>_command(app, exit_code) that declares its options and sets the callback; main.cpp lists them.
namespace dismantle::cli {

/// docs/cli.md.
enum class ExitCode { Done = 0, No = 1, Usage = 2, Unreadable = 3, Failed = 4 };

/// The options that every command knows.
struct CommonOptions {
  std::string assembly_file;
  ImportOptions import;
  double tolerance = 0;
  double fit = 0;
  ClassifyRule pairs = ClassifyRule::Auto;
  std::size_t simplify = 0;
  DeviceChoice device = DeviceChoice::Auto;
  bool uses_device = false;  ///< The command does what `device` says; else it is computed on the CPU.
  int threads = 0;
  bool json = false;
  bool quiet = false;
};

/// Declares the common options on a command. `options` must outlive the parse.
void add_common_options(CLI::App& command, CommonOptions& options);
/// Declares the positional ASSEMBLY argument.
void add_assembly_argument(CLI::App& command, CommonOptions& options);

/// True if the file name is that of a path: *.path.json.
bool is_path_file(const std::string& file);
/// The assembly that a path file is of, which lies beside it. Errors: Unreadable where there is none.
Result<std::filesystem::path> assembly_beside(const std::string& path_file, const Path& path);

/// Says on stderr where a path was made from another version of the assembly.
void note_other_version(const Path& path, const Assembly& assembly);

/// Prints progress on one line of stderr where that is a terminal, and cancels on Ctrl+C.
ProgressCallback progress_printer(const CommonOptions& options);

/// Says on stderr that it is the CPU, where a CUDA device was asked for.
void note_cpu(const CommonOptions& options, const std::string& why);

/// The threads that the user asked for.
Executor make_executor(const CommonOptions& options);

/// Loads and, where asked for, simplifies the assembly.
Result<Assembly> load(const CommonOptions& options);

/// The pair states by the user's tolerance, fit and rule.
Result<PairStates> classify(const Assembly& assembly, const CommonOptions& options, double clearance = 0);

/// Prints "dismantle: <message>" on stderr and gives the exit code of the error's kind.
ExitCode report(const Error& error);

}  // namespace dismantle::cli
