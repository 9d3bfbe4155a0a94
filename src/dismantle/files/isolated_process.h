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

/// What a child process may use up before it is stopped.
struct IsolationLimits {
  std::uint64_t memory_bytes = std::uint64_t{8} << 30;  ///< Of memory that it allocates beyond what the parent has.
  double cpu_seconds = 3600;                            ///< Of all its threads together.
  double silence_seconds = 300;                         ///< Without a report, an answer or the end.
};

/// The child's end of the line to its parent. Safe from several threads.
class IsolatedLine {
 public:
  explicit IsolatedLine(int descriptor) : descriptor_(descriptor) {}

  /// Tells the parent what the child is doing and how far it is (0 to 1; below 0 where unknown). Reports of one stage
  /// that come thick and fast are thinned out.
  void report(std::string_view stage, double fraction);
  /// Appends to the bytes that the parent gets in the end.
  void write(const void* data, std::size_t size);
  /// Sends the Error that the parent shall return.
  void refuse(const Error& error);
  /// Says that the answer is whole; run_isolated does so when the work returns.
  void finish();

 private:
  void send(std::uint8_t kind, const void* data, std::size_t size);

  int descriptor_;
  std::mutex mutex_;
  std::string last_stage_;
  double last_report_ = -1;  ///< [s], of a monotonic clock
};

/// How the child ended.
enum class IsolatedEnding {
  Done,         ///< The work returned; its bytes are whole.
  Refused,      ///< The work returned an Error.
  Crashed,      ///< A signal, an unexpected exception or exit, or bytes that make no sense.
  OutOfMemory,  ///< It asked for more than IsolationLimits::memory_bytes.
  OutOfTime,    ///< It computed for longer than IsolationLimits::cpu_seconds.
  Silent,       ///< It said nothing for IsolationLimits::silence_seconds and was killed.
  Cancelled,    ///< The progress callback said so; it was killed.
  NotStarted,   ///< The system gave no process.
};

struct IsolatedResult {
  IsolatedEnding ending = IsolatedEnding::NotStarted;
  int signal = 0;                ///< Of Crashed, where a signal ended it.
  Error error;                   ///< Of Refused.
  std::vector<std::byte> bytes;  ///< Of Done.
};

/// What runs in the child. It may throw; it must not rely on threads of the parent.
using IsolatedWork = std::function<Result<Done>(IsolatedLine&)>;

/// Runs `work` in a child process and waits for it: a crash, endless loop or hunger for memory of the work ends the
/// child and not the caller. The child is a fork: it sees the parent's memory as it is, but none of its threads, so the
/// work must use only libraries whose thread pools the parent has not started. It has none of the
/// parent's files and sockets, its standard output and error go nowhere, it leaves no core file, and it dies with the
/// calling thread. Under the sanitizers, which reserve address space of their own, memory is not limited. `progress` is
/// called on the calling thread, at least ten times a second.
IsolatedResult run_isolated(const IsolatedWork& work, const IsolationLimits& limits, const ProgressCallback& progress);

}  // namespace dismantle
