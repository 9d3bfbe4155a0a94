// SPDX-License-Identifier: Apache-2.0
#include "apps/server/jobs.h"

#include <chrono>
#include <exception>

namespace dismantle::server {

namespace {

/// Between two pieces of news of one stage.
constexpr std::chrono::milliseconds kNewsInterval{100};

/// Runs a load; what it throws is an Error.
Result<Model> guarded(const Jobs::Load& load, const ProgressCallback& progress) {
  try {
    return load(progress);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::Failed, "the assembly cannot be opened (out of memory); simplify it or free memory"};
  } catch (const std::exception& error) {
    return Error{ErrorKind::Failed,
                 std::string("the assembly cannot be opened (") + error.what() + "); please report it"};
  }
}

}  // namespace

Jobs::~Jobs() {
  cancelled_ = true;
  if (thread_.joinable()) thread_.join();
}

Result<std::uint32_t> Jobs::start(std::string name, Load load) {
  if (running_)
    return Error{ErrorKind::Usage,
                 "'" + name + "' cannot be opened (another file is being opened); wait or cancel that"};
  if (thread_.joinable()) thread_.join();
  running_ = true;
  cancelled_ = false;
  ++last_;
  thread_ = std::thread([this, name = std::move(name), load = std::move(load)] { run(name, load); });
  return last_;
}

Result<Done> Jobs::cancel(std::uint32_t job) {
  if (!running_ || job != last_)
    return Error{ErrorKind::Usage, "nothing was cancelled (this import is not running); look at its last news"};
  cancelled_ = true;
  return Done{};
}

void Jobs::run(const std::string& name, const Load& load) {
  JobNews news{last_, name, "opening", -1, JobNews::Status::Running, {}};
  listener_.on_news(news);
  auto told = std::chrono::steady_clock::now();
  Result<Model> result = guarded(load, [&](std::string_view stage, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (stage != news.stage || now - told >= kNewsInterval) {
      told = now;
      news.stage = stage;
      news.fraction = fraction;
      listener_.on_news(news);
    }
    return !cancelled_.load();
  });

  running_ = false;  // who hears of the model or the news may start the next at once; start() waits for this thread
  news.fraction = 1;
  news.status = JobNews::Status::Done;
  if (!result) {
    news.status = cancelled_ ? JobNews::Status::Cancelled : JobNews::Status::Failed;
    news.error = result.error().message;
  } else {
    listener_.on_model(std::move(*result));
  }
  listener_.on_news(news);
}

}  // namespace dismantle::server
