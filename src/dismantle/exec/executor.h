// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace dismantle {

/// The way in which an Executor runs its items. Results are the same; only wall time differs.
enum class ExecutorKind {
  Serial,    ///< One after another, on the calling thread.
  Threads,   ///< On oneTBB's worker threads.
  Shuffled,  ///< One after another in a scrambled order, for tests that the order does not matter.
};

class ThreadBackend;

/// Runs kernels: functors of views that are called once per item with the item's index. Cheap to copy; copies share
/// their threads.
class Executor {
 public:
  /// Serial.
  Executor();
  /// @param thread_count for Threads: number of threads; 0 for as many as the machine runs at once. Ignored otherwise.
  explicit Executor(ExecutorKind kind, int thread_count = 0);

  /// As constructed.
  ExecutorKind kind() const { return kind_; }
  /// The number of threads that items run on; 1 unless the kind is Threads.
  int thread_count() const { return thread_count_; }

  /// Calls kernel(i) for every i in [0, count), in any order and possibly at the same time.
  template <class Kernel>
  void for_each(std::size_t count, const Kernel& kernel) const {
    run_chunks(count, kItemsPerChunk, [&kernel](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) kernel(i);
    });
  }

  /// As for_each, for items that are each worth a task of their own (a component, a file).
  template <class Kernel>
  void for_each_heavy(std::size_t count, const Kernel& kernel) const {
    run_chunks(count, 1, [&kernel](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) kernel(i);
    });
  }

  /// As for_each, but calls kernel(begin, end) for ranges of at most `items_per_range` items that make up [0, count):
  /// for kernels that stage their appends, and for items of known cost.
  template <class Kernel>
  void for_each_range(std::size_t count, std::size_t items_per_range, const Kernel& kernel) const {
    const std::size_t ranges = (count + items_per_range - 1) / items_per_range;
    run_chunks(ranges, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t first = i * items_per_range;
        kernel(first, first + items_per_range < count ? first + items_per_range : count);
      }
    });
  }

  /// Sorts keys ascending.
  void sort(Span<std::uint64_t> keys) const;

 private:
  static constexpr std::size_t kItemsPerChunk = 256;
  void run_chunks(std::size_t count, std::size_t chunk, const std::function<void(std::size_t, std::size_t)>& run) const;

  ExecutorKind kind_;
  int thread_count_;
  std::shared_ptr<const ThreadBackend> threads_;
};

}  // namespace dismantle
