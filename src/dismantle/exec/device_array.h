// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <memory>
#include <type_traits>
#include <utility>

namespace dismantle {

/// Memory allocated by a queue (HostQueue, CudaQueue), freed with its owner.
using DeviceMemory = std::unique_ptr<void, void (*)(void*)>;

/// An array in the memory of a queue's device, which is accessible there only.
template <class T>
class DeviceArray {
  static_assert(std::is_trivially_copyable_v<T>, "what goes to a device is copied byte by byte");

 public:
  DeviceArray() = default;
  /// `size` uninitialized values. @param queue allocates the memory
  template <class Queue>
  DeviceArray(const Queue& queue, std::size_t size) : memory_(queue.allocate(size * sizeof(T))), size_(size) {}
  /// A copy of values of the host. Returns when the copy is made.
  template <class Queue>
  DeviceArray(Queue& queue, Span<const T> values) : DeviceArray(std::as_const(queue), values.size()) {
    queue.copy_up(memory_.get(), values.data(), values.size() * sizeof(T));
    queue.wait();
  }

  ///@{ The values, for kernels.
  Span<T> view() { return {static_cast<T*>(memory_.get()), size_}; }
  Span<const T> view() const { return {static_cast<const T*>(memory_.get()), size_}; }
  ///@}
  /// The number of values.
  std::size_t size() const { return size_; }

 private:
  DeviceMemory memory_{nullptr, [](void*) {}};
  std::size_t size_ = 0;
};

/// The first `count` values of an array that is made larger where it is too small; then its content is lost. The first
/// time it gets just that size.
template <class T, class Queue>
Span<T> room_for(Queue& queue, DeviceArray<T>& array, std::size_t count) {
  if (array.size() < count) array = DeviceArray<T>(std::as_const(queue), array.size() == 0 ? count : count + count / 2);
  return array.view().subspan(0, count);
}

/// Copies values of the host to the beginning of an array, as room_for() gives it. Returns when the copy is made.
template <class T, class Queue>
Span<const T> upload(Queue& queue, DeviceArray<T>& array, Span<const T> values) {
  const Span<T> room = room_for(queue, array, values.size());
  queue.copy_up(room.data(), values.data(), values.size() * sizeof(T));
  queue.wait();
  return room;
}

/// An array on the host and its mirror on a device, for values that one writes and the other reads.
template <class T>
class MirroredArray {
  static_assert(std::is_trivially_copyable_v<T>, "what goes to a device is copied byte by byte");

 public:
  /// `size` uninitialized values on both sides. @param queue allocates the memory
  template <class Queue>
  MirroredArray(const Queue& queue, std::size_t size)
      : host_(queue.allocate_staging(size * sizeof(T))), device_(queue, size) {}

  ///@{ The values on the host.
  Span<T> on_host() { return {static_cast<T*>(host_.get()), device_.size()}; }
  Span<const T> on_host() const { return {static_cast<const T*>(host_.get()), device_.size()}; }
  ///@}
  ///@{ The values on the device, for kernels.
  Span<T> on_device() { return device_.view(); }
  Span<const T> on_device() const { return device_.view(); }
  ///@}

  /// Enqueues a copy from the host to the device.
  template <class Queue>
  void copy_up(Queue& queue) {
    queue.copy_up(on_device().data(), host_.get(), device_.size() * sizeof(T));
  }
  /// Enqueues a copy from the device to the host.
  template <class Queue>
  void copy_down(Queue& queue) {
    queue.copy_down(host_.get(), on_device().data(), device_.size() * sizeof(T));
  }

 private:
  DeviceMemory host_;
  DeviceArray<T> device_;
};

/// Copies the first `count` values to the host, after everything enqueued before is done.
template <class T, class Queue>
std::vector<T> brought_down(Queue& queue, const DeviceArray<T>& array, std::size_t count) {
  DISMANTLE_EXPECT(count <= array.size());
  std::vector<T> values(count);
  queue.copy_down(values.data(), array.view().data(), count * sizeof(T));
  queue.wait();
  return values;
}

}  // namespace dismantle
