// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dismantle {

/// Resource limits of a child process; it is killed when it exceeds one.
struct IsolationLimits {
  std::uint64_t memory_bytes = std::uint64_t{8} << 30;  ///< Private memory that it allocates [bytes].
  double cpu_seconds = 3600;                            ///< Processor time of all its threads together [s].
  double silence_seconds = 300;                         ///< Time without any message from the child [s].
};

/// What a child process runs, and what it may read.
struct IsolatedProgram {
  std::filesystem::path file;                   ///< Its main() calls run_isolated_child().
  std::string request;                          ///< Given to its work.
  std::vector<std::filesystem::path> readable;  ///< Files, and folders with all that is in them.
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
  NotStarted,   ///< The system could not start the program.
};

/// The ending and the result of a child process.
struct IsolatedResult {
  IsolatedEnding ending = IsolatedEnding::NotStarted;  ///< How it ended.
  int signal = 0;                                      ///< Crashed: the signal that ended it, or 0.
  Error error;                                         ///< Refused: the Error that the work returned.
  std::vector<std::byte> bytes;                        ///< Done: the result. It may be hostile: check it.
};

/// Runs a program in a child process and waits for it: a crash, an endless loop or exhausted memory ends the child and
/// not the caller. The child confines itself before it looks at anything (isolated_child.h); it has none of the
/// parent's files and sockets, its standard output and error are discarded, it leaves no core file, and it dies with
/// the calling thread. Safe to call in a process with threads. Under the sanitizers, which reserve address space of
/// their own, memory is not limited. `progress` is called on the calling thread, at least ten times a second.
IsolatedResult run_isolated(const IsolatedProgram& program, const IsolationLimits& limits,
                            const ProgressCallback& progress);

}  // namespace dismantle
