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

/// The progress of a job: the event `job` of docs/wire.md.
struct JobNews {
  enum class Status { Running, Done, Failed, Cancelled };
  std::uint32_t job = 0;
  std::string name;
  std::string stage;
  double fraction = -1;
  Status status = Status::Running;
  std::string error;
};

/// Long work on a thread of its own, one at a time: imports and searches.
class Jobs {
 public:
  /// Publishes the result of a job.
  using Finish = std::function<void()>;
  using Work = std::function<Result<Finish>(const ProgressCallback&)>;
  /// Called on the job's thread.
  using Listener = std::function<void(const JobNews&)>;

  explicit Jobs(Listener on_news) : on_news_(std::move(on_news)) {}
  ~Jobs() { stop(); }
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Starts one. Its Finish is called on the job's thread, when another may be started and before the last news.
  /// For any thread. @return its number. Errors: Usage where one is running.
  Result<std::uint32_t> start(std::string name, Work work);
  /// Cancels the one that runs; of others nothing. For any thread. Errors: Usage where it does not run.
  Result<Done> cancel(std::uint32_t job);
  /// Cancels what runs, waits for it, and starts no more.
  void stop();

 private:
  void run(const std::string& name, const Work& work);

  Listener on_news_;
  std::mutex mutex_;  ///< Of starting and stopping.
  std::thread thread_;
  bool stopped_ = false;
  std::atomic<std::uint32_t> last_ = 0;
  std::atomic<bool> running_ = false, cancelled_ = false;
};

}  // namespace dismantle::server
