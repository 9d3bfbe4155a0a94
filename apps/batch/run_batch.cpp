// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/run_batch.h"

#include "apps/batch/claim_folder.h"
#include "apps/batch/stop_signal.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <set>

namespace dismantle::batch {

namespace fs = std::filesystem;

namespace {

constexpr int kTickMilliseconds = 100;
constexpr int kExitDone = 0, kExitFailed = 4;

/// A message of a worker, short enough for one atomic write.
struct Message {
  std::uint32_t item = 0;
  BatchProgress progress = BatchProgress::Found;
};

[[noreturn]] void worker_process(const BatchJob& job, int pipe, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kExitFailed);
  const auto report = [pipe](std::uint32_t item, BatchProgress progress) {
    const Message message{item, progress};
    while (write(pipe, &message, sizeof message) < 0 && errno == EINTR) {
    }
  };
  const Result<Done> done = run_worker(job, report);
  if (!done) std::fprintf(stderr, "dismantle: %s\n", done.error().message.c_str());
  _exit(done ? kExitDone : kExitFailed);
}

/// The workers of this process, and the pipe for their messages.
class Workers {
 public:
  explicit Workers(const BatchJob& job) : job_(job) {
    if (pipe2(pipe_, O_CLOEXEC | O_NONBLOCK) != 0) pipe_[0] = pipe_[1] = -1;
  }
  ~Workers() {
    for (const pid_t worker : running_) kill(worker, SIGTERM);
    for (const pid_t worker : running_) waitpid(worker, nullptr, 0);
    for (const int end : pipe_) close(end);
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Starts a worker. @return false if the system cannot create a process
  bool start_one() {
    if (pipe_[0] < 0) return false;
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child == 0) {
      fcntl(pipe_[1], F_SETFL, 0);
      worker_process(job_, pipe_[1], parent);
    }
    if (child > 0) running_.insert(child);
    return child > 0;
  }
  bool any() const { return !running_.empty(); }
  void stop() const {
    for (const pid_t worker : running_) kill(worker, SIGTERM);
  }
  /// Waits for messages for a short time and reports them.
  void receive(const BatchReport& report) const {
    pollfd readable{pipe_[0], POLLIN, 0};
    poll(&readable, 1, kTickMilliseconds);
    Message message;
    while (read(pipe_[0], &message, sizeof message) == sizeof message) report(message.item, message.progress);
  }
  /// Number of workers that have ended since the last call, killed or with an error.
  struct Ended {
    int killed = 0, failed = 0;
  };
  Ended collect() {
    Ended ended;
    for (auto worker = running_.begin(); worker != running_.end();) {
      int status = 0;
      if (waitpid(*worker, &status, WNOHANG) != *worker) {
        ++worker;
        continue;
      }
      ended.killed += WIFSIGNALED(status) ? 1 : 0;
      ended.failed += WIFEXITED(status) && WEXITSTATUS(status) != kExitDone ? 1 : 0;
      worker = running_.erase(worker);
    }
    return ended;
  }

 private:
  const BatchJob& job_;
  int pipe_[2];
  std::set<pid_t> running_;
};

Error no_process() {
  return {ErrorKind::Failed, "the batch cannot continue (the system cannot create a process); close other programs"};
}

Result<Done> prepare(const BatchJob& job, const BatchRunOptions& options) {
  std::error_code error;
  fs::create_directories(job.work_folder(), error);
  if (error)
    return Error{ErrorKind::Failed, job.output.string() + " cannot be written (" + error.message() +
                                        "); check the folder, its permissions and the free space"};
  if (!options.retry_failed) return Done{};
  for (const BatchItem& item : job.items) {
    const std::optional<BatchResult> result = find_result(job, item);
    if (result && result->failed()) remove_result(job, item);
  }
  return Done{};
}

/// Starts the workers and waits until all have ended.
Result<Done> supervise(const BatchJob& job, const BatchRunOptions& options) {
  std::vector<bool> reported(job.items.size(), false), existed;
  for (const BatchItem& item : job.items) existed.push_back(find_result(job, item).has_value());
  const auto report_once = [&](std::uint32_t item, BatchProgress) {
    if (reported[item]) return;
    reported[item] = true;
    // A result that another worker of this run has just made counts as made.
    if (options.report) options.report(item, existed[item] ? BatchProgress::Found : BatchProgress::Made);
  };
  Workers workers(job);
  const auto wanted = std::min<std::size_t>(static_cast<std::size_t>(options.workers), job.items.size());
  for (std::size_t k = 0; k < wanted; ++k)
    if (!workers.start_one()) return no_process();

  int restarts = static_cast<int>(wanted) + static_cast<int>(job.items.size()) * job.limits.attempts;
  bool stopping = false, failed = false;
  while (workers.any()) {
    workers.receive(report_once);
    const Workers::Ended ended = workers.collect();
    failed = failed || ended.failed > 0;
    if ((stop_requested() || failed) && !stopping) {
      stopping = true;
      workers.stop();
    }
    for (int k = 0; k < ended.killed && !stopping; ++k)
      if (--restarts < 0 || !workers.start_one()) return no_process();
  }
  workers.receive(report_once);
  if (stop_requested())
    return Error{ErrorKind::Failed, "the batch is incomplete (cancelled); start it again to continue"};
  if (failed) return Error{ErrorKind::Failed, "the batch is incomplete (see above); start it again to continue"};
  return Done{};
}

}  // namespace

Result<BatchTables> run_batch(const BatchJob& job, const BatchRunOptions& options) {
  watch_stop_signal();
  if (Result<Done> prepared = prepare(job, options); !prepared) return prepared.error();
  if (Result<Done> done = supervise(job, options); !done) return done.error();
  Result<BatchTables> tables = write_tables(job);
  std::error_code ignored;
  ClaimFolder(job.work_folder(), job.lease_seconds).remove_abandoned();
  fs::remove(job.work_folder(), ignored);  // fails if another worker still uses it
  return tables;
}

}  // namespace dismantle::batch
