// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace dismantle {

/// True where a sanitizer watches the process: it needs memory, files and system calls of its own.
inline constexpr bool kUnderSanitizer =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
    true;
#else
    false;
#endif
#else
    false;
#endif

/// What the kernel holds a confined process to.
struct Confinement {
  bool files = false;  ///< It opens nothing but what it may read (Landlock; Linux 5.13 and later, where it is enabled).
  bool calls = false;  ///< It makes only the system calls that reading and computing take (seccomp).
};

/// Confines this process for good, to reading and computing: it may read the given files and folders (with all that is
/// in them) and the system's libraries, write to files that are open, and start threads. It cannot open anything else,
/// change a file, reach the network, start a program, signal another process, or map memory that it both writes and
/// executes. Does what the kernel can, and returns what that was; nothing under the sanitizers. To be called while the
/// process has one thread.
Confinement confine(const std::vector<std::filesystem::path>& readable);

}  // namespace dismantle
