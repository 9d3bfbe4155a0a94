// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/server/spawned_program.h"
#include "tests/server/test_client.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace dismantle::server::testing_client {

/// The program `dismantle view` as a process of its own.
class ViewerProcess {
 public:
  /// Starts it on a file and waits for its URL. Throws std::runtime_error if it prints none. It is killed at the end of
  /// the scope.
  /// @param folder for its state, temporary files and messages
  /// @param limits its limits; where it runs and its files are set here
  ViewerProcess(const std::filesystem::path& file, const std::filesystem::path& folder, SpawnOptions limits = {});

  const ServerAddress& address() const { return address_; }
  /// The process. Others may only send signals to it.
  SpawnedProgram& program() { return *program_; }
  /// Sends a signal and waits. @return the exit code; 128 + the signal if that ended it
  int end(int signal);
  /// What it printed on its standard error.
  std::string messages() const;
  /// Resident memory [bytes].
  std::size_t memory() const;
  /// Processor time so far [s].
  double processor_seconds() const;
  /// Number of open files.
  std::size_t descriptors() const;
  /// Where it makes its temporary files.
  std::filesystem::path temporary_folder() const { return folder_ / "tmp"; }

 private:
  std::filesystem::path proc(const std::string& name) const;

  std::filesystem::path folder_;
  std::unique_ptr<SpawnedProgram> program_;
  ServerAddress address_;
};

}  // namespace dismantle::server::testing_client
