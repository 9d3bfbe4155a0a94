// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/device_array.h"
#include "dismantle/exec/executor.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <new>

namespace dismantle {

/// The host in the place of a device, with the interface of CudaQueue: what is enqueued runs at once, in order, on an
/// executor's threads. So everything that runs on a device but its copies and launches runs, and is tested, where there
/// is none. Memory that it gives is filled with bytes that make no sense as values: what is read before it was set
/// shows.
///
/// A queue is in order: what is enqueued sees all that was enqueued before.
class HostQueue {
 public:
  /// Marks that times are taken between; one for each stage's end.
  static constexpr int kMarkCount = 8;

  /// What was recorded of a queue, to be run again. Nothing here: running it again is enqueueing it again.
  class Recording {
   public:
    void forget() {}
  };

  explicit HostQueue(Executor executor) : executor_(std::move(executor)) {}

  /// Memory of the device, for values of any type.
  DeviceMemory allocate(std::size_t bytes) const {
    void* memory = ::operator new(bytes > 0 ? bytes : 1, kAlignment);
    std::memset(memory, 0xc5, bytes);
    return {memory, [](void* m) { ::operator delete(m, kAlignment); }};
  }
  /// Memory of the host that the device can copy from and to at any time.
  DeviceMemory allocate_staging(std::size_t bytes) const { return allocate(bytes); }

  void copy_up(void* device, const void* host, std::size_t bytes) { copy(device, host, bytes); }
  void copy_down(void* host, const void* device, std::size_t bytes) { copy(host, device, bytes); }
  void copy(void* to, const void* from, std::size_t bytes) {
    if (bytes > 0) std::memcpy(to, from, bytes);
  }

  /// Runs body(i) for every i in [0, count), in any order and at the same time.
  template <class Body>
  void launch(std::size_t count, const Body& body) {
    executor_.for_each(count, body);
  }

  /// How much memory sort() needs for so many keys [bytes].
  std::size_t sort_scratch_bytes(std::size_t count) const {
    static_cast<void>(count);
    return 0;
  }
  /// Sorts keys by their low `bits` bits, ascending, from one place to another.
  /// @pre the places do not overlap; `scratch` has sort_scratch_bytes(from.size())
  void sort(Span<const std::uint64_t> from, Span<std::uint64_t> to, int bits, Span<std::byte> scratch) {
    static_cast<void>(scratch);
    const std::uint64_t mask = bits < 64 ? (std::uint64_t{1} << bits) - 1 : ~std::uint64_t{0};
    copy(to.data(), from.data(), from.size() * sizeof(std::uint64_t));
    std::stable_sort(to.begin(), to.end(),
                     [mask](std::uint64_t x, std::uint64_t y) { return (x & mask) < (y & mask); });
  }

  /// Runs what `enqueue` enqueues; on a device it is recorded the first time, and later the recording is launched
  /// whole. `enqueue` must enqueue the same until `recording` is made to forget, and must not wait.
  template <class Enqueue>
  void replay(Recording& recording, const Enqueue& enqueue) {
    static_cast<void>(recording);
    enqueue();
  }

  void mark(int index) { marks_[index] = Clock::now(); }
  /// The time between two marks of what was waited for [ms].
  double milliseconds(int from, int to) const {
    return std::chrono::duration<double, std::milli>(marks_[to] - marks_[from]).count();
  }
  /// Waits until everything enqueued is done.
  void wait() {}

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::align_val_t kAlignment{64};

  Executor executor_;
  Clock::time_point marks_[kMarkCount] = {};
};

}  // namespace dismantle
