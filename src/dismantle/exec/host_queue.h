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

/// A host emulation of a device queue, with the interface of CudaQueue: enqueued work runs at once on an executor's
/// threads. It lets the device algorithms run, and be tested, without a device. Its memory is filled with bytes that
/// make no sense as values, so that reads of uninitialized values show.
///
/// A queue is in order: work sees the results of everything enqueued before it.
class HostQueue {
 public:
  /// Number of marks that times can be taken between.
  static constexpr int kMarkCount = 8;

  /// Recorded work, to be run again. Empty for the host, which enqueues the work again.
  class Recording {
   public:
    /// Drops the record: the next replay() records again.
    void forget() {}
  };

  /// Runs work on an executor's threads.
  explicit HostQueue(Executor executor) : executor_(std::move(executor)) {}

  /// Allocates memory of the device, aligned for any type.
  DeviceMemory allocate(std::size_t bytes) const {
    void* memory = ::operator new(bytes > 0 ? bytes : 1, kAlignment);
    std::memset(memory, 0xc5, bytes);
    return {memory, [](void* m) { ::operator delete(m, kAlignment); }};
  }
  /// Allocates memory of the host that the device can copy from and to at any time.
  DeviceMemory allocate_staging(std::size_t bytes) const { return allocate(bytes); }

  ///@{ Enqueues a copy of `bytes` bytes: from the host to the device, from the device to the host, or within the
  /// device.
  void copy_up(void* device, const void* host, std::size_t bytes) { copy(device, host, bytes); }
  void copy_down(void* host, const void* device, std::size_t bytes) { copy(host, device, bytes); }
  void copy(void* to, const void* from, std::size_t bytes) {
    if (bytes > 0) std::memcpy(to, from, bytes);
  }
  ///@}

  /// Enqueues body(i) for every i in [0, count), in any order and possibly at the same time.
  template <class Body>
  void launch(std::size_t count, const Body& body) {
    executor_.for_each(count, body);
  }

  /// Enqueues body(i) for every i in [0, min(room, *counted)), as launch() does. @param counted in the device's memory,
  /// read when the work is done
  template <class Body>
  void launch_counted(std::size_t room, const std::uint64_t* counted, const Body& body) {
    executor_.for_each(std::min<std::uint64_t>(room, *counted), body);
  }

  /// The memory that sort() needs for so many keys [bytes].
  std::size_t sort_scratch_bytes(std::size_t count) const {
    static_cast<void>(count);
    return 0;
  }
  /// Enqueues a stable sort of the keys of `from` into `to`, ascending by their low `bits` bits.
  /// @pre `from` and `to` do not overlap; `scratch` has sort_scratch_bytes(from.size())
  void sort(Span<const std::uint64_t> from, Span<std::uint64_t> to, int bits, Span<std::byte> scratch) {
    static_cast<void>(scratch);
    const std::uint64_t mask = bits < 64 ? (std::uint64_t{1} << bits) - 1 : ~std::uint64_t{0};
    copy(to.data(), from.data(), from.size() * sizeof(std::uint64_t));
    std::stable_sort(to.begin(), to.end(),
                     [mask](std::uint64_t x, std::uint64_t y) { return (x & mask) < (y & mask); });
  }

  /// Enqueues the work that enqueue() enqueues. A device records it the first time and then launches the record, so
  /// enqueue() must always enqueue the same work until the recording forgets it, and must not wait.
  template <class Enqueue>
  void replay(Recording& recording, const Enqueue& enqueue) {
    static_cast<void>(recording);
    enqueue();
  }

  /// Enqueues a mark. @param index in [0, kMarkCount)
  void mark(int index) { marks_[index] = Clock::now(); }
  /// The time between two marks [ms]. @pre both are done: wait() was called since
  double milliseconds(int from, int to) const {
    return std::chrono::duration<double, std::milli>(marks_[to] - marks_[from]).count();
  }
  /// Waits until everything that was enqueued is done.
  void wait() {}

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::align_val_t kAlignment{64};

  Executor executor_;
  Clock::time_point marks_[kMarkCount] = {};
};

}  // namespace dismantle
