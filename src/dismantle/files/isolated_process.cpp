// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/isolated_process.h"

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
#include <cstring>
#include <fstream>
#include <new>

namespace dismantle {

namespace {

// A message on the channel: its kind, the length of its payload (eight bytes, native order), the payload.
constexpr std::uint8_t kReport = 1;   // the fraction (a double), then the stage
constexpr std::uint8_t kBytes = 2;    // a piece of the answer
constexpr std::uint8_t kRefusal = 3;  // the ErrorKind (one byte), then the message
constexpr std::uint8_t kEnd = 4;      // the answer is whole
constexpr std::size_t kHeaderSize = 1 + sizeof(std::uint64_t);
constexpr std::size_t kLargestPayload = std::size_t{1} << 20;

constexpr int kExitDone = 0;
constexpr int kExitOutOfMemory = 17;
constexpr int kExitException = 18;

constexpr double kReportInterval = 0.05;  // [s], between two reports of one stage
constexpr int kTickMilliseconds = 100;    // between two calls of the progress callback, at most
constexpr int kPiecesPerTick = 64;        // reads between two looks at the child and the clock

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

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

void redirect_to_null(int descriptor) {
  const int null = open("/dev/null", O_RDWR);
  if (null < 0) return;
  dup2(null, descriptor);
  if (null != descriptor) close(null);
}

/// Ends the process if the parent no longer reads.
void write_all(int descriptor, const std::byte* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = write(descriptor, data, size);
    if (count < 0 && errno != EINTR) _exit(kExitException);
    if (count <= 0) continue;
    data += count;
    size -= static_cast<std::size_t>(count);
  }
}

int run_work(const IsolatedWork& work, IsolatedLine& line) {
  try {
    const Result<Done> result = work(line);
    if (!result) line.refuse(result.error());
    return kExitDone;
  } catch (const std::bad_alloc&) {
    return kExitOutOfMemory;
  } catch (...) {
    return kExitException;
  }
}

[[noreturn]] void run_child(const IsolatedWork& work, const IsolationLimits& limits, int descriptor, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kExitException);  // the parent died before it was watched
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) redirect_to_null(fd);
  // The work must not see the parent's files and sockets.
  const auto line_end = static_cast<unsigned>(descriptor);
  if (line_end > STDERR_FILENO + 1) close_range(STDERR_FILENO + 1, line_end - 1, 0);
  close_range(line_end + 1, ~0u, 0);
  for (const int sig : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) signal(sig, SIG_DFL);

  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, static_cast<std::uint64_t>(limits.cpu_seconds) + 1);
  if (!kSanitized) set_limit(RLIMIT_DATA, data_size() + limits.memory_bytes);

  IsolatedLine line(descriptor);
  const int status = run_work(work, line);
  if (status == kExitDone) line.finish();
  _exit(status);
}

/// The parent's side: parses messages as they arrive.
class Listener {
 public:
  explicit Listener(IsolatedResult& result) : result_(result) {}

  /// False if a message is malformed.
  bool take(const std::byte* data, std::size_t size) {
    pending_.insert(pending_.end(), data, data + size);
    std::size_t offset = 0;
    while (pending_.size() - offset >= kHeaderSize) {
      const auto kind = static_cast<std::uint8_t>(pending_[offset]);
      std::uint64_t length = 0;
      std::memcpy(&length, &pending_[offset + 1], sizeof length);
      if (length > kLargestPayload) return false;
      if (pending_.size() - offset - kHeaderSize < length) break;
      if (!take_message(kind, pending_.data() + offset + kHeaderSize, length)) return false;
      offset += kHeaderSize + length;
    }
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(offset));
    return true;
  }

  bool ended() const { return ended_; }
  bool refused() const { return refused_; }
  const std::string& stage() const { return stage_; }
  double fraction() const { return fraction_; }

 private:
  bool take_message(std::uint8_t kind, const std::byte* payload, std::size_t length) {
    const char* text = reinterpret_cast<const char*>(payload);
    switch (kind) {
      case kReport:
        if (length < sizeof fraction_) return false;
        std::memcpy(&fraction_, payload, sizeof fraction_);
        stage_.assign(text + sizeof fraction_, length - sizeof fraction_);
        return true;
      case kBytes:
        result_.bytes.insert(result_.bytes.end(), payload, payload + length);
        return true;
      case kRefusal:
        if (length < 1 || static_cast<std::uint8_t>(payload[0]) > static_cast<std::uint8_t>(ErrorKind::Failed))
          return false;
        result_.error = {static_cast<ErrorKind>(payload[0]), std::string(text + 1, length - 1)};
        return refused_ = true;
      case kEnd:
        return ended_ = true;
      default:
        return false;
    }
  }

  IsolatedResult& result_;
  std::vector<std::byte> pending_;
  std::string stage_ = "starting";
  double fraction_ = -1;
  bool ended_ = false, refused_ = false;
};

/// Reads without blocking. Returns the bytes read; 0 at the end or if there is nothing to read.
std::size_t read_available(int descriptor, std::vector<std::byte>& buffer) {
  const ssize_t count = read(descriptor, buffer.data(), buffer.size());
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

/// Translates a status of waitpid, if the channel reported no other ending.
void judge_exit(int status, const Listener& listener, IsolatedResult& result) {
  const bool whole = WIFEXITED(status) && WEXITSTATUS(status) == kExitDone && listener.ended();
  result.ending = IsolatedEnding::Crashed;
  if (whole) result.ending = listener.refused() ? IsolatedEnding::Refused : IsolatedEnding::Done;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kExitOutOfMemory) result.ending = IsolatedEnding::OutOfMemory;
  if (!WIFSIGNALED(status)) return;
  result.signal = WTERMSIG(status);
  if (result.signal == SIGXCPU) result.ending = IsolatedEnding::OutOfTime;
  if (result.signal == SIGKILL) result.ending = IsolatedEnding::OutOfMemory;  // the kernel, when memory runs out
}

/// Receives until the child ends; kills it if it is silent, cancelled or sends malformed messages.
void listen_to(pid_t child, int descriptor, const IsolationLimits& limits, const ProgressCallback& progress,
               IsolatedResult& result) {
  Listener listener(result);
  std::vector<std::byte> buffer(std::size_t{1} << 20);
  double last_word = seconds_now(), last_tick = last_word - 1;
  const auto kill_as = [&](IsolatedEnding ending) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    result.ending = ending;
  };

  for (;;) {
    int status = 0;
    const pid_t waited = waitpid(child, &status, WNOHANG);
    const bool gone = waited == child || (waited < 0 && errno == ECHILD);  // the latter where SIGCHLD is ignored
    pollfd line{descriptor, POLLIN, 0};
    if (!gone) poll(&line, 1, kTickMilliseconds);
    if (!gone && (line.revents & POLLHUP) && !(line.revents & POLLIN)) usleep(1000);  // it is about to end

    std::size_t count = 0;
    for (int piece = 0; (gone || piece < kPiecesPerTick) && (count = read_available(descriptor, buffer)) > 0; ++piece) {
      last_word = seconds_now();
      if (listener.take(buffer.data(), count)) continue;
      if (gone) return void(result.ending = IsolatedEnding::Crashed);
      return kill_as(IsolatedEnding::Crashed);
    }
    if (gone) return judge_exit(status, listener, result);

    const double now = seconds_now();
    if (now - last_word > limits.silence_seconds) return kill_as(IsolatedEnding::Silent);
    if (now - last_tick < kTickMilliseconds * 1e-3) continue;
    last_tick = now;
    if (!report_progress(progress, listener.stage(), listener.fraction())) return kill_as(IsolatedEnding::Cancelled);
  }
}

}  // namespace

void IsolatedLine::send(std::uint8_t kind, const void* data, std::size_t size) {
  std::byte header[kHeaderSize];
  const std::uint64_t length = size;
  header[0] = static_cast<std::byte>(kind);
  std::memcpy(&header[1], &length, sizeof length);
  write_all(descriptor_, header, sizeof header);
  write_all(descriptor_, static_cast<const std::byte*>(data), size);
}

void IsolatedLine::report(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  const double now = seconds_now();
  if (stage == last_stage_ && now - last_report_ < kReportInterval) return;
  last_stage_ = stage;
  last_report_ = now;
  std::string payload(sizeof fraction, '\0');
  std::memcpy(payload.data(), &fraction, sizeof fraction);
  payload += stage.substr(0, 1000);
  send(kReport, payload.data(), payload.size());
}

void IsolatedLine::write(const void* data, std::size_t size) {
  const std::lock_guard lock(mutex_);
  const auto* bytes = static_cast<const std::byte*>(data);
  for (std::size_t offset = 0; offset < size; offset += kLargestPayload)
    send(kBytes, bytes + offset, std::min(kLargestPayload, size - offset));
}

void IsolatedLine::refuse(const Error& error) {
  const std::lock_guard lock(mutex_);
  std::string payload(1, static_cast<char>(error.kind));
  payload += error.message.substr(0, kLargestPayload / 2);
  send(kRefusal, payload.data(), payload.size());
}

void IsolatedLine::finish() {
  const std::lock_guard lock(mutex_);
  send(kEnd, nullptr, 0);
}

IsolatedResult run_isolated(const IsolatedWork& work, const IsolationLimits& limits, const ProgressCallback& progress) {
  IsolatedResult result;
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) return result;
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    run_child(work, limits, ends[1], parent);
  }
  close(ends[1]);
  if (child > 0) {
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
    listen_to(child, ends[0], limits, progress, result);
  }
  close(ends[0]);
  if (result.ending != IsolatedEnding::Done) result.bytes.clear();
  return result;
}

}  // namespace dismantle
