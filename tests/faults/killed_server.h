// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "tests/faults/kill_table.h"
#include "tests/server/viewer_process.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dismantle::faults {

/// A pose that the server has sent, and when it came.
struct AcknowledgedPose {
  std::chrono::steady_clock::time_point at;
  Pose pose;
};

/// The age at `killed` of the oldest pose that the path's last move lacks [s]; 0 if it has all.
double loss_of(const std::vector<AcknowledgedPose>& poses, const Path& path,
               std::chrono::steady_clock::time_point killed);

/// The viewer, killed while a client works with it, and started again.
class KilledServer {
 public:
  /// @param folder for its files; a stack of boxes in a tube is written there
  explicit KilledServer(std::filesystem::path folder);

  /// Kills the viewer while a box is dragged. The next one must resume, with a recording that passes the audit and
  /// lacks nothing that is older than kMaxLoss.
  void kill_during_drag(KillRow& row, KillDice& dice);
  /// Kills the viewer after a drag, while it plans or opens a STEP file. The recording of the drag must be restored.
  void kill_during_search(KillRow& row, KillDice& dice);

  /// Starts the viewer. @param limits its limits
  std::unique_ptr<server::testing_client::ViewerProcess> start(server::testing_client::SpawnOptions limits = {}) const;
  std::filesystem::path folder() const { return folder_; }
  std::filesystem::path stack() const { return folder_ / "root/stack.obj"; }
  const Assembly& assembly() const { return assembly_; }

 private:
  enum class Job { Plan, Open };
  static server::Json start_job(server::testing_client::Client& client, Job job);
  void remember_durations();
  void check_restart(KillRow& row, const std::vector<AcknowledgedPose>& poses,
                     std::chrono::steady_clock::time_point killed, const std::string& recording) const;
  void count_files_left(KillRow& row) const;

  std::filesystem::path folder_;
  std::string mark_;
  Assembly assembly_;
  double seconds_[2] = {0, 0};  ///< Duration of each Job; 0: not measured yet.
};

/// Waits for the end of the job that a command has started. Throws std::runtime_error if it was refused.
/// @return its last event
server::Json end_of_job(server::testing_client::Client& client, const server::Json& reply);

/// Drags a component of the stack along a random path until the server is gone, or for `seconds`.
std::vector<AcknowledgedPose> drag_randomly(server::testing_client::Client& client, KillDice& dice, double seconds);

}  // namespace dismantle::faults
