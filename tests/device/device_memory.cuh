// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <cuda_runtime.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

namespace dismantle::device {

/// Stops the program where a CUDA call failed: in a test that is the report.
inline void check(cudaError_t error, const char* what) {
  if (error == cudaSuccess) return;
  std::fprintf(stderr, "CUDA: %s failed (%s)\n", what, cudaGetErrorString(error));
  std::exit(1);
}

/// Values in a device's memory.
template <class T>
class DeviceArray {
 public:
  explicit DeviceArray(std::size_t size) : size_(size) {
    if (size > 0) check(cudaMalloc(&data_, size * sizeof(T)), "cudaMalloc");
  }
  /// A copy of values of the host.
  explicit DeviceArray(Span<const T> values) : DeviceArray(values.size()) {
    if (size_ > 0) check(cudaMemcpy(data_, values.data(), size_ * sizeof(T), cudaMemcpyHostToDevice), "copy to device");
  }
  DeviceArray(const DeviceArray&) = delete;
  DeviceArray& operator=(const DeviceArray&) = delete;
  ~DeviceArray() { cudaFree(data_); }

  Span<T> view() { return {data_, size_}; }
  Span<const T> view() const { return {data_, size_}; }
  T* data() { return data_; }
  /// The first `count` values as the host has them.
  std::vector<T> values(std::size_t count) const {
    std::vector<T> copy(count);
    if (count > 0) check(cudaMemcpy(copy.data(), data_, count * sizeof(T), cudaMemcpyDeviceToHost), "copy to host");
    return copy;
  }
  std::vector<T> values() const { return values(size_); }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// What a kernel appends to on a device, as AppendView is on the host: what does not fit is counted, not stored.
template <class T>
struct DeviceAppendView {
  Span<T> storage;
  unsigned long long* needed;

  __device__ void append(const T& value) const {
    const unsigned long long place = atomicAdd(needed, 1ull);
    if (place < storage.size()) storage[place] = value;
  }
};

/// Owns the storage of a DeviceAppendView.
template <class T>
class DeviceAppendBuffer {
 public:
  explicit DeviceAppendBuffer(std::size_t capacity)
      : storage_(std::make_unique<DeviceArray<T>>(capacity)), needed_(1) {}

  /// Empties the buffer and gives the view for a kernel to append to.
  DeviceAppendView<T> start() {
    check(cudaMemset(needed_.data(), 0, sizeof(unsigned long long)), "cudaMemset");
    return {storage_->view(), needed_.data()};
  }
  std::size_t needed() const { return needed_.values()[0]; }
  /// Makes room for what was needed where it did not fit. @return true where it did not
  bool grown() {
    const std::size_t count = needed();
    if (count <= storage_->view().size()) return false;
    storage_ = std::make_unique<DeviceArray<T>>(count + count / 2);
    return true;
  }
  /// @pre everything fits
  std::vector<T> values() const { return storage_->values(needed()); }

 private:
  std::unique_ptr<DeviceArray<T>> storage_;
  DeviceArray<unsigned long long> needed_;
};

/// One thread an item.
template <class Body>
__global__ void run_items(std::size_t count, Body body) {
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i < count) body(i);
}

inline constexpr unsigned kThreadsPerBlock = 128;

inline unsigned block_count(std::size_t items) {
  return static_cast<unsigned>((items + kThreadsPerBlock - 1) / kThreadsPerBlock);
}

inline void finish(const char* what) {
  check(cudaGetLastError(), what);
  check(cudaDeviceSynchronize(), what);
}

/// Runs body(i) for every i in [0, count), and waits.
template <class Body>
void for_each(std::size_t count, const Body& body, const char* what) {
  if (count > 0) run_items<<<block_count(count), kThreadsPerBlock>>>(count, body);
  finish(what);
}

}  // namespace dismantle::device
