// SPDX-License-Identifier: Apache-2.0
#include "apps/server/jobs.h"

#include <chrono>
#include <exception>

namespace dismantle::server {

namespace {

/// Between two pieces of news of one stage.
constexpr std::chrono::milliseconds kNewsInterval{100};

/// Does a work; what it throws is an Error.
Result<Jobs::Finish> guarded(const std::string& name, const Jobs::Work& work, const ProgressCallback& progress) {
  try {
    return work(progress);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::Failed, "'" + name + "' failed (out of memory); simplify the assembly or free memory"};
  } catch (const std::exception& error) {
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
  thread_ = std::thread([this, name = std::move(name), work = std::move(work)] { run(name, work); });
  return last_.load();
}

Result<Done> Jobs::cancel(std::uint32_t job) {
  if (!running_ || job != last_)
    return Error{ErrorKind::Usage, "nothing was cancelled (the job has ended); see its last event"};
  cancelled_ = true;
  return Done{};
}

void Jobs::run(const std::string& name, const Work& work) {
  JobNews news{last_, name, "starting", -1, JobNews::Status::Running, {}};
  on_news_(news);
  auto told = std::chrono::steady_clock::now();
  const Result<Finish> result = guarded(name, work, [&](std::string_view stage, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (stage != news.stage || now - told >= kNewsInterval) {
      told = now;
      news.stage = stage;
      news.fraction = fraction;
      on_news_(news);
    }
    return !cancelled_.load();
  });

  running_ = false;  // who hears of what was found may start the next at once; start() waits for this thread
  news.fraction = 1;
  news.status = JobNews::Status::Done;
  if (!result) {
    news.status = cancelled_ ? JobNews::Status::Cancelled : JobNews::Status::Failed;
    news.error = result.error().message;
  } else {
    (*result)();
  }
  on_news_(news);
}

}  // namespace dismantle::server
