// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/faults/folder_contents.h"
#include "tests/faults/kill_table.h"
#include "tests/faults/run_command.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dismantle::faults {

/// A command of the program that writes into the folder `out`, relative to the folder in which it runs.
struct FaultCommand {
  std::string kind;                        ///< Name of the row.
  std::vector<std::string> arguments;      ///< Of the program.
  std::vector<std::string> redone;         ///< Outputs that the earlier state lacks, by the start of their names.
  std::vector<std::string> run_dependent;  ///< Outputs that differ from run to run, such as costs.
};

/// The commands, whose input they write into a folder: `import` reads a STEP file with a cache, `plan`, `export` (one
/// of each of four formats) and `batch`.
std::vector<FaultCommand> fault_commands(const std::filesystem::path& folder, const std::string& kind);

/// A command that is killed again and again, and its undisturbed result.
class KilledCommand {
 public:
  /// Runs it three times undisturbed: from nothing, with a cache, and with earlier outputs. Throws std::runtime_error
  /// if the results are not equal.
  /// @param folder with its input
  KilledCommand(std::filesystem::path folder, FaultCommand command);

  /// Kills one run, examines what it left, and runs the command again.
  void kill_once(KillRow& row, KillDice& dice) const;

 private:
  std::filesystem::path out() const { return folder_ / "out"; }
  std::filesystem::path cache() const { return folder_ / "cache"; }
  std::filesystem::path temporary() const { return folder_ / "tmp"; }
  server::testing_client::SpawnOptions options() const;
  CommandEnd run() const;
  /// Makes the outputs those of an earlier run, or none, and the cache filled or empty.
  void prepare(bool with_earlier, bool with_cache) const;
  bool depends_on_run(const std::string& name) const;
  bool is_whole(const std::string& name, const std::string& bytes) const;
  bool equals_reference(const FolderContents& contents) const;
  void check_outputs(KillRow& row, const FolderContents& after, bool had_earlier) const;
  void check_rerun(KillRow& row, const FolderContents& after) const;
  void count_files_left(KillRow& row) const;

  std::filesystem::path folder_;
  FaultCommand command_;
  std::string mark_;
  FolderContents reference_, earlier_, filled_cache_;
  double seconds_ = 0;  ///< Duration of the undisturbed run without a cache.
  int exit_code_ = 0;
};

/// Waits for processes with a variable in their environment to end; kills and counts those that do not.
void check_processes_left(KillRow& row, const std::string& variable);

}  // namespace dismantle::faults
