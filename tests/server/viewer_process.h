// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/server/test_client.h"

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace dismantle::server::testing_client {

/// The program `dismantle view` as a process of its own.
class ViewerProcess {
 public:
  /// Starts it on a file and waits for its URL.
  /// @param folder for its state, temporary files and messages
  /// @param max_descriptors its limit of open files; 0: that of this process
  ViewerProcess(const std::filesystem::path& file, const std::filesystem::path& folder, int max_descriptors = 0);
  /// Kills it.
  ~ViewerProcess();
  ViewerProcess(const ViewerProcess&) = delete;
  ViewerProcess& operator=(const ViewerProcess&) = delete;

  const ServerAddress& address() const { return address_; }
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
  pid_t process_ = 0;
  ServerAddress address_;
};

}  // namespace dismantle::server::testing_client
