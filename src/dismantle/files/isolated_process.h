// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// Resource limits of a child process; it is killed when it exceeds one.
struct IsolationLimits {
  std::uint64_t memory_bytes = std::uint64_t{8} << 30;  ///< Private memory allocated beyond the parent's own [bytes].
  double cpu_seconds = 3600;                            ///< Processor time of all its threads together [s].
  double silence_seconds = 300;                         ///< Time without any message from the child [s].
};

/// The child's end of the message channel to its parent. Thread-safe.
class IsolatedLine {
 public:
  /// A channel that writes to an open file descriptor, which the caller keeps open.
  explicit IsolatedLine(int descriptor) : descriptor_(descriptor) {}

  /// Tells the parent what the child is doing and how far it is (0 to 1; below 0 where unknown). Frequent reports of
  /// one stage are thinned out.
  void report(std::string_view stage, double fraction);
  /// Appends to the result bytes that the parent receives.
  void write(const void* data, std::size_t size);
  /// Sends the Error that the parent is to return.
  void refuse(const Error& error);
  /// Marks the result as complete; run_isolated calls it when the work returns.
  void finish();

 private:
  void send(std::uint8_t kind, const void* data, std::size_t size);

  int descriptor_;
  std::mutex mutex_;
  std::string last_stage_;
  double last_report_ = -1;  ///< [s], of a monotonic clock
};

/// The ways in which a child process can end.
enum class IsolatedEnding {
  Done,         ///< The work returned; its bytes are whole.
  Refused,      ///< The work returned an Error.
  Crashed,      ///< A signal, an unexpected exception or exit, or malformed messages.
  OutOfMemory,  ///< It asked for more than IsolationLimits::memory_bytes.
  OutOfTime,    ///< It computed for longer than IsolationLimits::cpu_seconds.
  Silent,       ///< It sent nothing for IsolationLimits::silence_seconds and was killed.
  Cancelled,    ///< The progress callback asked for it; it was killed.
  NotStarted,   ///< The system could not start a process.
};

/// The ending and the result of a child process.
struct IsolatedResult {
  IsolatedEnding ending = IsolatedEnding::NotStarted;  ///< How it ended.
  int signal = 0;                                      ///< Crashed: the signal that ended it, or 0.
  Error error;                                         ///< Refused: the Error that the work returned.
  std::vector<std::byte> bytes;                        ///< Done: the result.
};

/// A function that runs in the child. It may throw; it must not rely on threads of the parent.
using IsolatedWork = std::function<Result<Done>(IsolatedLine&)>;

/// Runs `work` in a child process and waits for it: a crash, an endless loop or exhausted memory ends the
/// child and not the caller. The child is a fork: it sees the parent's memory as it is, but none of its threads, so the
/// work must use only libraries whose thread pools the parent has not started. It has none of the
/// parent's files and sockets, its standard output and error are discarded, it leaves no core file, and it dies with
/// the calling thread. Under the sanitizers, which reserve address space of their own, memory is not limited.
/// `progress` is called on the calling thread, at least ten times a second.
IsolatedResult run_isolated(const IsolatedWork& work, const IsolationLimits& limits, const ProgressCallback& progress);

}  // namespace dismantle
