// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/batch_worker.h"

#include "apps/batch/batch_result.h"
#include "apps/batch/claim_folder.h"
#include "apps/batch/stop_signal.h"
#include "dismantle/files/isolated_process.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <numeric>
#include <thread>

namespace dismantle::batch {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds kFirstPause(50), kLongestPause(1000);  // while others work on what is left

std::string host_name() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  return name;
}

/// The sentence of what did not end well.
std::string failure(const BatchItem& item, const IsolatedResult& result) {
  switch (result.ending) {
    case IsolatedEnding::Refused:
      return result.error.message;
    case IsolatedEnding::OutOfMemory:
      return item.name + " was given up (it needs more memory than it may have); try --memory or --simplify";
    case IsolatedEnding::OutOfTime:
    case IsolatedEnding::Silent:
      return item.name + " was given up (it came to no end within its computing time); try --cpu-time or --simplify";
    default:
      return item.name + " was given up (the work on it crashed); check the file in the program that wrote it";
  }
}

/// True if the work was ended from outside, which says nothing about the item.
bool was_stopped(const IsolatedResult& result) {
  return stop_requested() || result.ending == IsolatedEnding::Cancelled ||
         result.ending == IsolatedEnding::NotStarted ||
         (result.ending == IsolatedEnding::Crashed && (result.signal == SIGINT || result.signal == SIGTERM));
}

IsolatedResult examine(const BatchJob& job, const BatchItem& item, Claim& claim) {
  IsolationLimits limits;
  limits.memory_bytes = static_cast<std::uint64_t>(job.limits.memory_gib * static_cast<double>(1 << 30));
  limits.cpu_seconds = job.limits.cpu_seconds;
  limits.silence_seconds = job.limits.cpu_seconds;
  const auto work = [&](IsolatedLine& line) -> Result<Done> {
    const Result<std::string> summary = job.work(item, claim.workplace());
    if (!summary) return summary.error();
    line.write(summary->data(), summary->size());
    return Done{};
  };
  return run_isolated(work, limits, [&](std::string_view, double) {
    claim.renew(job.lease_seconds);
    return !stop_requested();
  });
}

/// True where the item has its result now.
Result<bool> make_result(const BatchJob& job, const BatchItem& item, Claim& claim) {
  const auto start = std::chrono::steady_clock::now();
  std::error_code error;
  fs::create_directories(claim.workplace(), error);
  if (error)
    return Error{ErrorKind::Failed, claim.workplace().string() + " cannot be made (" + error.message() +
                                        "); check the folder, its permissions and the free space"};
  BatchResult result{"", "{}"};
  if (claim.attempt() > job.limits.attempts) {
    result.error = item.name + " was given up (" + std::to_string(job.limits.attempts) +
                   " processes died over it); free memory, or leave it out";
  } else {
    const IsolatedResult isolated = examine(job, item, claim);
    if (was_stopped(isolated)) return false;
    if (isolated.ending == IsolatedEnding::Done) {
      result.summary.assign(reinterpret_cast<const char*>(isolated.bytes.data()), isolated.bytes.size());
    } else {
      result.error = failure(item, isolated);
    }
  }
  if (!claim.holds()) return false;  // taken over: what was made here may have been disturbed
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Result<Done> published = publish_result(job, item, claim.workplace(), result, {seconds, host_name()});
  if (!published) return published.error();
  return true;
}

/// The outcome of one visit to an item.
enum class Look { Found, Made, Open };

Result<Look> look_at(const BatchJob& job, const BatchItem& item, ClaimFolder& claims) {
  if (find_result(job, item)) return Look::Found;
  std::optional<Claim> claim = claims.take(item.folder);
  if (!claim) return Look::Open;
  if (find_result(job, item)) {
    claim->release();
    return Look::Found;
  }
  const Result<bool> made = make_result(job, item, *claim);
  claim->release();
  if (!made) return made.error();
  return *made ? Look::Made : Look::Open;
}

}  // namespace

Result<Done> work_through(const BatchJob& job, const BatchReport& report) {
  std::vector<std::uint32_t> open(job.items.size());
  std::iota(open.begin(), open.end(), 0);
  std::stable_sort(open.begin(), open.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return job.items[a].bytes > job.items[b].bytes; });
  ClaimFolder claims(job.workshop(), job.lease_seconds);
  auto pause = kFirstPause;
  while (!open.empty() && !stop_requested()) {
    std::vector<std::uint32_t> still_open;
    for (const std::uint32_t i : open) {
      if (stop_requested()) return Done{};
      const Result<Look> look = look_at(job, job.items[i], claims);
      if (!look) return look.error();
      if (*look == Look::Open) {
        still_open.push_back(i);
      } else {
        report(i, *look == Look::Made ? BatchProgress::Made : BatchProgress::Found);
      }
    }
    if (still_open.size() == open.size()) {
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, kLongestPause);
    } else {
      pause = kFirstPause;
    }
    open = std::move(still_open);
  }
  return Done{};
}

}  // namespace dismantle::batch
