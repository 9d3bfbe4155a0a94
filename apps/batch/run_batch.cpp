// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/run_batch.h"

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

[[noreturn]] void be_worker(const BatchJob& job, int line, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kExitFailed);
  const auto tell = [line](std::uint32_t item, BatchProgress progress) {
    const Message message{item, progress};
    while (write(line, &message, sizeof message) < 0 && errno == EINTR) {
    }
  };
  const Result<Done> done = work_through(job, tell);
  if (!done) std::fprintf(stderr, "dismantle: %s\n", done.error().message.c_str());
  _exit(done ? kExitDone : kExitFailed);
}

/// The workers of this machine, and the line on which they tell.
class Workers {
 public:
  explicit Workers(const BatchJob& job) : job_(job) {
    if (pipe2(line_, O_CLOEXEC | O_NONBLOCK) != 0) line_[0] = line_[1] = -1;
  }
  ~Workers() {
    for (const pid_t worker : running_) kill(worker, SIGTERM);
    for (const pid_t worker : running_) waitpid(worker, nullptr, 0);
    for (const int end : line_) close(end);
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// False where the system gives no process.
  bool start_one() {
    if (line_[0] < 0) return false;
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child == 0) {
      fcntl(line_[1], F_SETFL, 0);
      be_worker(job_, line_[1], parent);
    }
    if (child > 0) running_.insert(child);
    return child > 0;
  }
  bool any() const { return !running_.empty(); }
  void stop() const {
    for (const pid_t worker : running_) kill(worker, SIGTERM);
  }
  /// Waits a little for what they tell.
  void listen(const BatchReport& report) const {
    pollfd line{line_[0], POLLIN, 0};
    poll(&line, 1, kTickMilliseconds);
    Message message;
    while (read(line_[0], &message, sizeof message) == sizeof message) report(message.item, message.progress);
  }
  /// Number of workers that have ended since, killed or with an error.
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
  int line_[2];
  std::set<pid_t> running_;
};

Error no_process() {
  return {ErrorKind::Failed, "the batch cannot go on (the system gives no process); close something"};
}

Result<Done> prepare(const BatchJob& job, const BatchRunOptions& options) {
  std::error_code error;
  fs::create_directories(job.workshop(), error);
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

/// Until every worker has ended.
Result<Done> supervise(const BatchJob& job, const BatchRunOptions& options) {
  std::vector<bool> reported(job.items.size(), false), was_there;
  for (const BatchItem& item : job.items) was_there.push_back(find_result(job, item).has_value());
  const auto report_once = [&](std::uint32_t item, BatchProgress) {
    if (reported[item]) return;
    reported[item] = true;
    // A worker finds what another has just made: to the run that is made.
    if (options.report) options.report(item, was_there[item] ? BatchProgress::Found : BatchProgress::Made);
  };
  Workers workers(job);
  const auto wanted = std::min<std::size_t>(static_cast<std::size_t>(options.workers), job.items.size());
  for (std::size_t k = 0; k < wanted; ++k)
    if (!workers.start_one()) return no_process();

  int restarts = static_cast<int>(wanted) + static_cast<int>(job.items.size()) * job.limits.attempts;
  bool told = false, failed = false;
  while (workers.any()) {
    workers.listen(report_once);
    const Workers::Ended ended = workers.collect();
    failed = failed || ended.failed > 0;
    if ((stop_requested() || failed) && !told) {
      told = true;
      workers.stop();
    }
    for (int k = 0; k < ended.killed && !told; ++k)
      if (--restarts < 0 || !workers.start_one()) return no_process();
  }
  workers.listen(report_once);
  if (stop_requested())
    return Error{ErrorKind::Failed, "the batch is not done (cancelled); start it again, and it goes on"};
  if (failed) return Error{ErrorKind::Failed, "the batch is not done (see above); start it again, and it goes on"};
  return Done{};
}

}  // namespace

Result<BatchTables> run_batch(const BatchJob& job, const BatchRunOptions& options) {
  watch_stop_signal();
  if (Result<Done> prepared = prepare(job, options); !prepared) return prepared.error();
  if (Result<Done> done = supervise(job, options); !done) return done.error();
  Result<BatchTables> tables = write_tables(job);
  std::error_code ignored;
  fs::remove(job.workshop(), ignored);  // where nobody else works in it any more
  return tables;
}

}  // namespace dismantle::batch
