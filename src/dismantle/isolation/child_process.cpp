// SPDX-License-Identifier: Apache-2.0
#include "dismantle/isolation/child_process.h"

#include "dismantle/isolation/confinement.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <new>

namespace dismantle {

namespace {

constexpr int kTickMilliseconds = 100;  // between two calls of the progress callback, at most
constexpr int kPiecesPerTick = 64;      // reads between two looks at the child and the clock

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Private writable memory of this process [bytes], as RLIMIT_DATA counts it.
std::uint64_t data_size() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t field[6] = {};
  for (std::uint64_t& f : field) statm >> f;
  return statm ? field[5] * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

void set_limit(decltype(RLIMIT_CORE) resource, std::uint64_t value) {
  rlimit limit{};
  getrlimit(resource, &limit);
  limit.rlim_cur = std::min<std::uint64_t>(value, limit.rlim_max);
  setrlimit(resource, &limit);
}

/// Reads without blocking. Returns the bytes read; 0 at the end or if there is nothing to read.
std::size_t read_available(int descriptor, std::vector<std::byte>& buffer) {
  const ssize_t count = read(descriptor, buffer.data(), buffer.size());
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

/// Translates a status of waitpid, if the channel reported no other ending.
void judge_exit(int status, IsolatedLineReader& listener, IsolatedResult& result) {
  const bool whole = WIFEXITED(status) && WEXITSTATUS(status) == kExitDone && listener.ended();
  result.ending = IsolatedEnding::Crashed;
  if (whole) result.ending = listener.refused() ? IsolatedEnding::Refused : IsolatedEnding::Done;
  if (result.ending == IsolatedEnding::Refused) result.error = listener.error();
  if (result.ending == IsolatedEnding::Done) result.bytes = std::move(listener.bytes());
  if (WIFEXITED(status) && WEXITSTATUS(status) == kExitOutOfMemory) result.ending = IsolatedEnding::OutOfMemory;
  if (!WIFSIGNALED(status)) return;
  result.signal = WTERMSIG(status);
  if (result.signal == SIGXCPU) result.ending = IsolatedEnding::OutOfTime;
  if (result.signal == SIGKILL) result.ending = IsolatedEnding::OutOfMemory;  // the kernel, when memory runs out
}

}  // namespace

IsolatedResult listen_to_child(pid_t child, int descriptor, const IsolationLimits& limits,
                               const ProgressCallback& progress) {
  fcntl(descriptor, F_SETFL, O_NONBLOCK);
  IsolatedResult result;
  IsolatedLineReader listener;
  std::vector<std::byte> buffer(std::size_t{1} << 20);
  double last_word = seconds_now(), last_tick = last_word - 1;
  bool gone = false;
  const auto kill_as = [&](IsolatedEnding ending) {
    if (!gone) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
    result.ending = ending;
    return result;
  };

  for (;;) {
    int status = 0;
    const pid_t waited = waitpid(child, &status, WNOHANG);
    gone = waited == child || (waited < 0 && errno == ECHILD);  // the latter where SIGCHLD is ignored
    pollfd line{descriptor, POLLIN, 0};
    if (!gone) poll(&line, 1, kTickMilliseconds);
    if (!gone && (line.revents & POLLHUP) && !(line.revents & POLLIN)) usleep(1000);  // it is about to end

    std::size_t count = 0;
    for (int piece = 0; (gone || piece < kPiecesPerTick) && (count = read_available(descriptor, buffer)) > 0; ++piece) {
      last_word = seconds_now();
      if (listener.take(buffer.data(), count) && listener.bytes().size() <= limits.memory_bytes) continue;
      return kill_as(IsolatedEnding::Crashed);
    }
    if (gone) return judge_exit(status, listener, result), result;

    const double now = seconds_now();
    if (now - last_word > limits.silence_seconds) return kill_as(IsolatedEnding::Silent);
    if (now - last_tick < kTickMilliseconds * 1e-3) continue;
    last_tick = now;
    if (!report_progress(progress, listener.stage(), listener.fraction())) return kill_as(IsolatedEnding::Cancelled);
  }
}

bool follow_parent(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  return getppid() == parent;
}

void set_limits(const IsolationLimits& limits) {
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, static_cast<std::uint64_t>(limits.cpu_seconds) + 1);
  if (!kUnderSanitizer) set_limit(RLIMIT_DATA, data_size() + limits.memory_bytes);
}

int work_for_parent(const std::function<Result<Done>(IsolatedLine&)>& work, int descriptor) {
  IsolatedLine line(descriptor);
  try {
    const Result<Done> result = work(line);
    if (!result) line.refuse(result.error());
    line.finish();
    return kExitDone;
  } catch (const std::bad_alloc&) {
    return kExitOutOfMemory;
  } catch (...) {
    return kExitException;
  }
}

}  // namespace dismantle
