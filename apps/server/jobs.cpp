// SPDX-License-Identifier: Apache-2.0
#include "apps/server/jobs.h"

#include "apps/server/lack_of_memory.h"

#include <chrono>
#include <exception>

namespace dismantle::server {

namespace {

/// Minimum interval between two updates of one stage.
constexpr std::chrono::milliseconds kUpdateInterval{100};

/// Does the work; exceptions become errors.
Result<Jobs::Outcome> run_guarded(const std::string& name, const Jobs::Work& work, const ProgressCallback& progress) {
  try {
    return work(progress);
  } catch (const std::exception& error) {
    if (is_lack_of_memory(error))
      return Error{ErrorKind::Failed, "'" + name + "' failed (out of memory); simplify the assembly or free memory"};
    return Error{ErrorKind::Failed, "'" + name + "' failed (" + error.what() + "); please report it"};
  }
}

}  // namespace

void Jobs::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = cancelled_ = true;
  if (thread_.joinable()) thread_.join();
}

Result<std::uint32_t> Jobs::start(std::string name, Work work) {
  const std::lock_guard lock(mutex_);
  if (running_ || stopped_)
    return Error{ErrorKind::Usage,
                 "'" + name + "' cannot be started (another job is running); wait for it or cancel it"};
  if (thread_.joinable()) thread_.join();
  running_ = true;
  cancelled_ = false;
  ++last_;
  thread_ =
      std::thread([this, name = std::move(name), work = std::move(work)]() mutable { run(name, std::move(work)); });
  return last_.load();
}

Result<Done> Jobs::cancel(std::uint32_t job) {
  const std::lock_guard lock(mutex_);  // no other job may start in between, and be cancelled
  if (!running_ || job != last_)
    return Error{ErrorKind::Usage, "nothing was cancelled (the job has ended); see its last event"};
  cancelled_ = true;
  return Done{};
}

void Jobs::run(const std::string& name, Work work) {
  using Clock = std::chrono::steady_clock;
  JobUpdate update{last_, name, "starting", -1, 0, JobUpdate::Status::Running, {}};
  on_update_(update);
  const Clock::time_point start = Clock::now();
  Clock::time_point last_update = start;
  const auto seconds = [start] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const Result<Outcome> result = run_guarded(name, work, [&](std::string_view stage, double fraction) {
    const Clock::time_point now = Clock::now();
    if (stage != update.stage || now - last_update >= kUpdateInterval) {
      last_update = now;
      update.stage = stage;
      update.fraction = fraction;
      update.seconds = seconds();
      on_update_(update);
    }
    return !cancelled_.load();
  });

  work = nullptr;    // what it holds, such as an upload, goes before the job ends
  running_ = false;  // Finish may cause the start of another job; start() waits for this thread
  update.fraction = 1;
  update.seconds = seconds();
  update.status = result && result->is_cancelled ? JobUpdate::Status::Cancelled : JobUpdate::Status::Done;
  if (!result) {
    update.status = cancelled_ ? JobUpdate::Status::Cancelled : JobUpdate::Status::Failed;
    update.error = result.error().message;
  } else {
    result->publish();
  }
  on_update_(update);
}

}  // namespace dismantle::server
