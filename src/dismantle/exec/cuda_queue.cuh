// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/cuda_device.h"
#include "dismantle/exec/device_array.h"

#include <cuda_runtime.h>
#include <cub/device/device_radix_sort.cuh>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace dismantle {

/// Throws a CudaError if a call failed.
inline void check_cuda(cudaError_t error, const char* call) {
  if (error != cudaSuccess) throw CudaError(std::string(call) + " failed (" + cudaGetErrorString(error) + ")");
}

/// Threads of a block of run_items.
inline constexpr unsigned kThreadsPerBlock = 128;

/// Runs a body with one thread per item.
template <class Body>
__global__ void __launch_bounds__(kThreadsPerBlock) run_items(std::size_t count, const Body body) {
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i < count) body(i);
}

/// Runs a body for as many items as the device has counted, at most `room`, on a grid that fills the device.
template <class Body>
__global__ void __launch_bounds__(kThreadsPerBlock)
    run_counted_items(std::size_t room, const std::uint64_t* counted, const Body body) {
  const std::uint64_t count = *counted < room ? *counted : room;
  const std::size_t stride = gridDim.x * static_cast<std::size_t>(blockDim.x);
  for (std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x; i < count; i += stride) body(i);
}

/// A stream of a CUDA device, with the interface that HostQueue documents. Copies and launches return before they are
/// done. Throws CudaError if a call fails.
class CudaQueue {
 public:
  static constexpr int kMarkCount = 8;

  class Recording {
   public:
    void forget() { graph_.reset(); }

   private:
    friend class CudaQueue;
    struct Destroy {
      void operator()(cudaGraphExec_t graph) const { cudaGraphExecDestroy(graph); }
    };
    std::unique_ptr<std::remove_pointer_t<cudaGraphExec_t>, Destroy> graph_;
  };

  CudaQueue() : state_(std::make_unique<State>()) {}

  DeviceMemory allocate(std::size_t bytes) const {
    void* memory = nullptr;
    check_cuda(cudaMalloc(&memory, bytes > 0 ? bytes : 1), "cudaMalloc");
    return {memory, [](void* m) { cudaFree(m); }};
  }
  DeviceMemory allocate_staging(std::size_t bytes) const {
    void* memory = nullptr;
    check_cuda(cudaMallocHost(&memory, bytes > 0 ? bytes : 1), "cudaMallocHost");
    return {memory, [](void* m) { cudaFreeHost(m); }};
  }

  void copy_up(void* device, const void* host, std::size_t bytes) { copy(device, host, bytes); }
  void copy_down(void* host, const void* device, std::size_t bytes) { copy(host, device, bytes); }
  void copy(void* to, const void* from, std::size_t bytes) {
    if (bytes > 0) check_cuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, state_->stream), "cudaMemcpyAsync");
  }

  template <class Body>
  void launch(std::size_t count, const Body& body) {
    if (count == 0) return;
    const auto blocks = static_cast<unsigned>((count + kThreadsPerBlock - 1) / kThreadsPerBlock);
    run_items<<<blocks, kThreadsPerBlock, 0, state_->stream>>>(count, body);
    check_cuda(cudaGetLastError(), "a kernel's launch");
  }

  template <class Body>
  void launch_counted(std::size_t room, const std::uint64_t* counted, const Body& body) {
    if (room == 0) return;
    const std::size_t blocks = std::min<std::size_t>((room + kThreadsPerBlock - 1) / kThreadsPerBlock, kCountedBlocks);
    run_counted_items<<<static_cast<unsigned>(blocks), kThreadsPerBlock, 0, state_->stream>>>(room, counted, body);
    check_cuda(cudaGetLastError(), "a kernel's launch");
  }

  /// The stream itself, for blocks that share memory and for CUB.
  cudaStream_t stream() const { return state_->stream; }

  std::size_t sort_scratch_bytes(std::size_t count) const {
    std::size_t bytes = 0;
    const std::uint64_t* from = nullptr;
    std::uint64_t* to = nullptr;
    check_cuda(cub::DeviceRadixSort::SortKeys(nullptr, bytes, from, to, count, 0, 64, state_->stream), "the sort");
    return bytes;
  }
  void sort(Span<const std::uint64_t> from, Span<std::uint64_t> to, int bits, Span<std::byte> scratch) {
    std::size_t bytes = scratch.size();
    check_cuda(cub::DeviceRadixSort::SortKeys(scratch.data(), bytes, from.data(), to.data(), from.size(), 0, bits,
                                              state_->stream),
               "the sort");
  }

  template <class Enqueue>
  void replay(Recording& recording, const Enqueue& enqueue) {
    if (!recording.graph_) record(recording, enqueue);
    check_cuda(cudaGraphLaunch(recording.graph_.get(), state_->stream), "cudaGraphLaunch");
  }

  void mark(int index) {
    const unsigned flags = state_->recording ? cudaEventRecordExternal : cudaEventRecordDefault;
    check_cuda(cudaEventRecordWithFlags(state_->marks[index], state_->stream, flags), "cudaEventRecord");
  }
  double milliseconds(int from, int to) const {
    float ms = 0;
    check_cuda(cudaEventElapsedTime(&ms, state_->marks[from], state_->marks[to]), "cudaEventElapsedTime");
    return ms;
  }
  void wait() { check_cuda(cudaStreamSynchronize(state_->stream), "a kernel or a copy"); }

 private:
  static constexpr std::size_t kCountedBlocks = 2048;  // some 16 for each multiprocessor of a large GPU

  struct State {
    cudaStream_t stream = nullptr;
    cudaEvent_t marks[kMarkCount] = {};
    bool recording = false;

    State() {
      check_cuda(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "cudaStreamCreate");
      for (cudaEvent_t& mark : marks) check_cuda(cudaEventCreate(&mark), "cudaEventCreate");
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
      for (cudaEvent_t mark : marks)
        if (mark != nullptr) cudaEventDestroy(mark);
      if (stream != nullptr) cudaStreamDestroy(stream);
    }
  };

  template <class Enqueue>
  void record(Recording& recording, const Enqueue& enqueue) {
    check_cuda(cudaStreamBeginCapture(state_->stream, cudaStreamCaptureModeThreadLocal), "cudaStreamBeginCapture");
    cudaGraph_t graph = nullptr;
    state_->recording = true;
    try {
      enqueue();
    } catch (...) {
      state_->recording = false;
      cudaStreamEndCapture(state_->stream, &graph);  // the stream must not stay in capture
      if (graph != nullptr) cudaGraphDestroy(graph);
      throw;
    }
    state_->recording = false;
    check_cuda(cudaStreamEndCapture(state_->stream, &graph), "cudaStreamEndCapture");
    cudaGraphExec_t executable = nullptr;
    const cudaError_t made = cudaGraphInstantiate(&executable, graph, 0);
    cudaGraphDestroy(graph);
    check_cuda(made, "cudaGraphInstantiate");
    recording.graph_.reset(executable);
  }

  std::unique_ptr<State> state_;
};

}  // namespace dismantle
