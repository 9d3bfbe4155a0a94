// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/batch_worker.h"

#include "apps/batch/batch_result.h"
#include "apps/batch/claim_folder.h"
#include "apps/batch/stop_signal.h"
#include "dismantle/isolation/forked_process.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <numeric>
#include <thread>

namespace dismantle::batch {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds kMinPause(50), kMaxPause(1000);  // while other workers have the remaining items

std::string host_name() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  return name;
}

/// The error message for work that did not succeed.
std::string failure(const BatchItem& item, const IsolatedResult& result) {
  switch (result.ending) {
    case IsolatedEnding::Refused:
      return result.error.message;
    case IsolatedEnding::OutOfMemory:
      return item.name + " was given up (it needs more memory than the limit); try --memory or --simplify";
    case IsolatedEnding::OutOfTime:
    case IsolatedEnding::Silent:
      return item.name + " was given up (it did not finish within its processor time); try --cpu-time or --simplify";
    default:
      return item.name + " was given up (the work on it crashed); check the file in the program that wrote it";
  }
}

/// True if the work was stopped from outside: not a failure of the item.
bool was_stopped(const IsolatedResult& result) {
  return stop_requested() || result.ending == IsolatedEnding::Cancelled ||
         result.ending == IsolatedEnding::NotStarted ||
         (result.ending == IsolatedEnding::Crashed && (result.signal == SIGINT || result.signal == SIGTERM));
}

IsolatedResult run_work(const BatchJob& job, const BatchItem& item, Claim& claim) {
  IsolationLimits limits;
  limits.memory_bytes = static_cast<std::uint64_t>(job.limits.memory_gib * static_cast<double>(1 << 30));
  limits.cpu_seconds = job.limits.cpu_seconds;
  limits.silence_seconds = job.limits.cpu_seconds;
  const auto work = [&](IsolatedLine& line) -> Result<Done> {
    const Result<std::string> summary = job.work(item, claim.scratch_folder());
    if (!summary) return summary.error();
    line.write(summary->data(), summary->size());
    return Done{};
  };
  return run_forked(work, limits, [&](std::string_view, double) {
    claim.renew(job.lease_seconds);
    return !stop_requested();
  });
}

/// True if the work could not write its output: no failure of the item, which another run would not do again.
bool lacks_output(const IsolatedResult& result, const Claim& claim) {
  const std::string folder = claim.scratch_folder().string();
  return result.ending == IsolatedEnding::Refused && result.error.kind == ErrorKind::Failed &&
         result.error.message.compare(0, folder.size(), folder) == 0;
}

/// Does the work on a claimed item. @return true if its result exists now
Result<bool> make_result(const BatchJob& job, const BatchItem& item, Claim& claim) {
  const auto start = std::chrono::steady_clock::now();
  std::error_code error;
  fs::create_directories(claim.scratch_folder(), error);
  if (error)
    return Error{ErrorKind::Failed, claim.scratch_folder().string() + " cannot be made (" + error.message() +
                                        "); check the folder, its permissions and the free space"};
  BatchResult result{"", "{}"};
  if (claim.attempt() > job.limits.attempts) {
    result.error = item.name + " was given up (" + std::to_string(job.limits.attempts) +
                   " processes died over it); free memory, or leave it out";
  } else {
    const IsolatedResult isolated = run_work(job, item, claim);
    if (was_stopped(isolated)) return false;
    if (lacks_output(isolated, claim)) return isolated.error;
    if (isolated.ending == IsolatedEnding::Done) {
      result.summary.assign(reinterpret_cast<const char*>(isolated.bytes.data()), isolated.bytes.size());
    } else {
      result.error = failure(item, isolated);
    }
  }
  if (!claim.is_held()) return false;  // taken over: the files may be incomplete
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Result<Done> published = publish_result(job, item, claim.scratch_folder(), result, {seconds, host_name()});
  if (!published) return published.error();
  return true;
}

/// Outcome of an attempt to process an item; Open: no result yet.
enum class Outcome { Found, Made, Open };

Result<Outcome> try_item(const BatchJob& job, const BatchItem& item, ClaimFolder& claims) {
  if (find_result(job, item)) return Outcome::Found;
  std::optional<Claim> claim = claims.try_claim(item.folder);
  if (!claim) return Outcome::Open;
  if (find_result(job, item)) {
    claim->release();
    return Outcome::Found;
  }
  const Result<bool> made = make_result(job, item, *claim);
  claim->release();
  if (!made) return made.error();
  return *made ? Outcome::Made : Outcome::Open;
}

}  // namespace

Result<Done> run_worker(const BatchJob& job, const BatchReport& report) {
  std::vector<std::uint32_t> open(job.items.size());
  std::iota(open.begin(), open.end(), 0);
  std::stable_sort(open.begin(), open.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return job.items[a].bytes > job.items[b].bytes; });
  ClaimFolder claims(job.work_folder(), job.lease_seconds);
  auto pause = kMinPause;
  while (!open.empty() && !stop_requested()) {
    std::vector<std::uint32_t> still_open;
    for (const std::uint32_t i : open) {
      if (stop_requested()) return Done{};
      const Result<Outcome> outcome = try_item(job, job.items[i], claims);
      if (!outcome) return outcome.error();
      if (*outcome == Outcome::Open) {
        still_open.push_back(i);
      } else {
        report(i, *outcome == Outcome::Made ? BatchProgress::Made : BatchProgress::Found);
      }
    }
    if (still_open.size() == open.size()) {
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, kMaxPause);
    } else {
      pause = kMinPause;
    }
    open = std::move(still_open);
  }
  return Done{};
}

}  // namespace dismantle::batch
