// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace dismantle {

/// The threads of an Executor of kind Threads. One of two implementations is linked: oneTBB, or standard threads where
/// there is none (DISMANTLE_CORE_ONLY), and for ThreadSanitizer builds, which report false races inside Debian's
/// oneTBB.
class ThreadBackend {
 public:
  virtual ~ThreadBackend() = default;
  /// Calls run(begin, end) for ranges of about `chunk` items that make up [0, count), possibly at the same time.
  virtual void run_chunks(std::size_t count, std::size_t chunk,
                          const std::function<void(std::size_t, std::size_t)>& run) const = 0;
  /// Sorts keys ascending.
  virtual void sort(Span<std::uint64_t> keys) const = 0;
};

/// Makes the linked implementation. @pre thread_count > 0
std::shared_ptr<const ThreadBackend> make_thread_backend(int thread_count);

}  // namespace dismantle
