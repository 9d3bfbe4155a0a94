// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dismantle::server::testing_client {

/// Where a program runs, and its limits. 0: the limit of this process.
struct SpawnOptions {
  std::vector<std::string> environment;  ///< All of it, as NAME=VALUE.
  std::filesystem::path out, err;        ///< Files for its output; empty: /dev/null.
  int out_pipe = -1;                     ///< A descriptor for its standard output, in place of the file.
  std::filesystem::path folder;          ///< Working folder; empty: that of this process.
  bool own_group = false;                ///< It leads a process group of its own.
  int max_descriptors = 0;               ///< Open files.
  std::size_t max_file_bytes = 0;        ///< Length of a file, in steps of 512.
  std::size_t max_memory_bytes = 0;      ///< Address space, in steps of 1024.
};

/// The program `dismantle` as a process of its own.
class SpawnedProgram {
 public:
  /// Starts it. Throws std::runtime_error if it cannot be started.
  /// @param arguments without the program's name
  SpawnedProgram(const std::vector<std::string>& arguments, const SpawnOptions& options);
  /// Kills it.
  ~SpawnedProgram();
  SpawnedProgram(const SpawnedProgram&) = delete;
  SpawnedProgram& operator=(const SpawnedProgram&) = delete;

  pid_t id() const { return process_; }
  /// Sends a signal to it.
  void signal(int signal) const;
  /// Sends a signal to it and to all of its process group. @pre own_group
  void signal_group(int signal) const;
  /// Waits for its end. @return the exit code; 128 + the signal if that ended it
  /// @pre its end was not waited for before; the same for wait_for()
  int wait();
  /// As wait(), at most for `seconds`; none if it still runs.
  std::optional<int> wait_for(double seconds);

 private:
  pid_t process_ = 0;
};

/// The processes that have `variable` (NAME=VALUE) in the environment with which they were started, without those that
/// have ended.
std::vector<pid_t> processes_with(const std::string& variable);

}  // namespace dismantle::server::testing_client
