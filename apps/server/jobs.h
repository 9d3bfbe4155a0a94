// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"

#include "apps/server/model.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

namespace dismantle::server {

/// How an import goes on: the event `job` of docs/wire.md.
struct JobNews {
  enum class Status { Running, Done, Failed, Cancelled };
  std::uint32_t job = 0;
  std::string name;
  std::string stage;
  double fraction = -1;
  Status status = Status::Running;
  std::string error;
};

/// Loads assemblies on a thread of its own, one at a time.
class Jobs {
 public:
  using Load = std::function<Result<Model>(const ProgressCallback&)>;
  /// Both are called on the job's thread.
  struct Listener {
    std::function<void(const JobNews&)> on_news;
    std::function<void(Model)> on_model;
  };

  explicit Jobs(Listener listener) : listener_(std::move(listener)) {}
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Starts one. @return its number. Errors: Usage where one is running.
  Result<std::uint32_t> start(std::string name, Load load);
  /// Cancels the one that runs; of others nothing. Errors: Usage where it does not run.
  Result<Done> cancel(std::uint32_t job);

 private:
  void run(const std::string& name, const Load& load);

  Listener listener_;
  std::thread thread_;
  std::uint32_t last_ = 0;
  std::atomic<bool> running_ = false, cancelled_ = false;
};

}  // namespace dismantle::server
