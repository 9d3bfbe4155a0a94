// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace dismantle::server {

/// The state of a job: the event `job` of docs/wire.md.
struct JobUpdate {
  /// The status of a job.
  enum class Status { Running, Done, Failed, Cancelled };
  std::uint32_t job = 0;            ///< Number of the job.
  std::string name;                 ///< Name for the user.
  std::string stage;                ///< What it does now, for the user.
  double fraction = -1;             ///< Fraction of the stage that is done; negative: unknown.
  double seconds = 0;               ///< Since the start [s].
  Status status = Status::Running;  ///< All but Running are final.
  std::string error;                ///< Failed, Cancelled: the message.
};

/// Runs imports and searches on a thread of its own, one at a time.
class Jobs {
 public:
  /// Publishes the result of a job.
  using Finish = std::function<void()>;
  /// How the work of a job ended.
  struct Outcome {
    Finish publish;             ///< Publishes the result.
    bool is_cancelled = false;  ///< The job was cancelled, and the result is what was found until then.
  };
  /// Does the work of a job.
  using Work = std::function<Result<Outcome>(const ProgressCallback&)>;
  /// Receives updates, on the job's thread.
  using Listener = std::function<void(const JobUpdate&)>;

  /// @param on_update receives an update when a job starts, changes its stage, progresses, and ends
  explicit Jobs(Listener on_update) : on_update_(std::move(on_update)) {}
  ~Jobs() { stop(); }
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Starts a job. Its Finish is called on the job's thread before the last update; from then on another job may be
  /// started. For any thread. @return the number of the job. Errors: Usage if one is running.
  Result<std::uint32_t> start(std::string name, Work work);
  /// Requests the cancellation of a job. For any thread. Errors: Usage if it is not running.
  Result<Done> cancel(std::uint32_t job);
  /// Cancels the running job and waits for its end; no other can be started. For any thread but the job's.
  void stop();

 private:
  void run(const std::string& name, Work work);

  Listener on_update_;
  std::mutex mutex_;  ///< Guards thread_, stopped_ and the start of jobs.
  std::thread thread_;
  bool stopped_ = false;
  std::atomic<std::uint32_t> last_ = 0;
  std::atomic<bool> running_ = false, cancelled_ = false;
};

}  // namespace dismantle::server
