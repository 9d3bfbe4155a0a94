// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/server/spawned_program.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dismantle::faults {

/// How a run of the program ended.
struct CommandEnd {
  int exit_code = -1;  ///< 128 + the signal that ended it.
  double seconds = 0;
  std::string out, err;
};

/// Files of the runs of a command, in one folder: its working folder, `cache`, `tmp`, `stdout` and `stderr`.
/// @param limits its limits, further variables of its environment, and its standard output if not that file
server::testing_client::SpawnOptions in_folder(const std::filesystem::path& folder,
                                               server::testing_client::SpawnOptions limits = {});

/// Runs the program to its end. @param options of in_folder()
CommandEnd run_command(const std::vector<std::string>& arguments, const server::testing_client::SpawnOptions& options);

}  // namespace dismantle::faults
