// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/append_buffer.h"
#include "dismantle/exec/cuda_queue.cuh"

#include <vector>

namespace dismantle {

/// AppendBuffer in a CUDA device's memory: values beyond the capacity are counted, not stored.
template <class T>
class DeviceAppendBuffer {
 public:
  /// @param queue must outlive the buffer
  DeviceAppendBuffer(CudaQueue& queue, std::size_t capacity)
      : queue_(&queue), storage_(queue, capacity), needed_(queue, 1) {}

  /// Empties the buffer and gives the view for kernels to append to.
  AppendView<T> start() {
    needed_.on_host()[0] = 0;
    needed_.copy_up(*queue_);
    return {storage_.view(), needed_.on_device().data()};
  }
  /// Waits for the launches and grows the buffer to the values counted. @return true if it had to grow
  bool grown() {
    needed_.copy_down(*queue_);
    queue_->wait();
    const std::size_t needed = needed_.on_host()[0];
    if (needed <= storage_.size()) return false;
    storage_ = DeviceArray<T>(*queue_, needed + needed / 2);
    return true;
  }
  /// The values on the host, in no particular order. @pre the last call of grown() returned false
  std::vector<T> values() { return brought_down(*queue_, storage_, needed_.on_host()[0]); }

 private:
  CudaQueue* queue_;
  DeviceArray<T> storage_;
  MirroredArray<std::uint64_t> needed_;
};

}  // namespace dismantle
