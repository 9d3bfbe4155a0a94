// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/device_appender.h"

#include "bench/baselines/device_append_buffer.cuh"
#include "dismantle/streams/stage_clock.h"

#include <cub/device/device_scan.cuh>

#include <algorithm>
#include <array>
#include <utility>

namespace dismantle {

namespace {

using Stream = FrontAppender::Stream;
constexpr std::size_t kStreamCount = FrontAppender::kStreamCount;

/// A view of each stream; kernels take it by value.
struct StreamViews {
  AppendView<std::uint64_t> stream[kStreamCount];
};

/// The sink of the kernel: passes each value on to `Derived::put(stream, value)`.
template <class Derived>
class DeviceSink {
 public:
  __device__ void triangle_pair(std::uint64_t key) { put(Stream::TrianglePairs, key); }
  __device__ void keep(std::uint64_t key) { put(Stream::Kept, key); }
  __device__ void rest(std::uint64_t key) { put(Stream::Rested, key); }
  __device__ void sprout(std::size_t index) { put(Stream::Sprouted, index); }
  __device__ void pend(std::uint64_t key) { put(Stream::Pending, key); }

 private:
  __device__ void put(Stream stream, std::uint64_t value) { static_cast<Derived*>(this)->put(stream, value); }
};

/// A round over the front: the first sprouts its nodes, later ones the items that were left pending.
struct FrontRound {
  FrontSproutKernel kernel;
  bool first = true;

  template <class Sink>
  __device__ void visit(std::size_t i, Sink& sink) const {
    if (first) {
      kernel.sprout_node(i, sink);
    } else {
      kernel.resume(i, sink);
    }
  }
};

/// Appends every value with an atomic addition of its own.
class GlobalLockSink : public DeviceSink<GlobalLockSink> {
 public:
  __device__ explicit GlobalLockSink(const StreamViews& views) : views_(views) {}
  __device__ void put(Stream stream, std::uint64_t value) { views_.stream[stream].append(value); }

 private:
  const StreamViews& views_;
};

struct SproutWithGlobalLock {
  FrontRound round;
  StreamViews views;

  __device__ void operator()(std::size_t i) const {
    GlobalLockSink sink(views);
    round.visit(i, sink);
  }
};

constexpr unsigned kThreadsPerBlock = 128;
constexpr unsigned kLocalCapacity = 256;  // 10 KiB of shared memory a block

/// A block's buffers in shared memory.
struct LocalBuffers {
  std::uint64_t values[kStreamCount][kLocalCapacity];
  unsigned count[kStreamCount];
  std::size_t offset[kStreamCount];
};

/// Appends to the block's buffers; once these are full, values go straight to the streams.
class LocalLockSink : public DeviceSink<LocalLockSink> {
 public:
  __device__ LocalLockSink(LocalBuffers& local, const StreamViews& views) : local_(local), views_(views) {}
  __device__ void put(Stream stream, std::uint64_t value) {
    const unsigned slot = atomicAdd(&local_.count[stream], 1u);
    if (slot < kLocalCapacity) {
      local_.values[stream][slot] = value;
    } else {
      views_.stream[stream].append(value);
    }
  }

 private:
  LocalBuffers& local_;
  const StreamViews& views_;
};

__global__ void sprout_with_local_lock(FrontRound round, StreamViews views) {
  __shared__ LocalBuffers local;
  if (threadIdx.x < kStreamCount) local.count[threadIdx.x] = 0;
  __syncthreads();
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i < round.kernel.items.size()) {
    LocalLockSink sink(local, views);
    round.visit(i, sink);
  }
  __syncthreads();
  if (threadIdx.x < kStreamCount) {
    const unsigned s = threadIdx.x;
    local.count[s] = local.count[s] < kLocalCapacity ? local.count[s] : kLocalCapacity;
    local.offset[s] = views.stream[s].take(local.count[s]);
  }
  __syncthreads();
  for (unsigned s = 0; s < kStreamCount; ++s)
    for (unsigned k = threadIdx.x; k < local.count[s]; k += blockDim.x)
      views.stream[s].put(local.offset[s] + k, local.values[s][k]);
}

/// Counts the values of an item.
class CountSink : public DeviceSink<CountSink> {
 public:
  __device__ void put(Stream stream, std::uint64_t) { ++count[stream]; }
  std::uint64_t count[kStreamCount] = {};
};

/// First pass of CountScanEmit: one row of counts for each stream, one count for each item.
struct CountValues {
  FrontRound round;
  Span<std::uint64_t> counts;

  __device__ void operator()(std::size_t i) const {
    CountSink sink;
    round.visit(i, sink);
    for (std::size_t s = 0; s < kStreamCount; ++s) counts[s * round.kernel.items.size() + i] = sink.count[s];
  }
};

/// Writes the values of an item from its offsets on.
class EmitSink : public DeviceSink<EmitSink> {
 public:
  __device__ explicit EmitSink(Span<std::uint64_t> values) : values_(values) {}
  __device__ void put(Stream stream, std::uint64_t value) { values_[offset[stream]++] = value; }
  std::uint64_t offset[kStreamCount] = {};

 private:
  Span<std::uint64_t> values_;
};

/// Second pass of CountScanEmit.
struct EmitValues {
  FrontRound round;
  Span<const std::uint64_t> offsets;  ///< Laid out as the counts of CountValues.
  Span<std::uint64_t> values;

  __device__ void operator()(std::size_t i) const {
    EmitSink sink(values);
    for (std::size_t s = 0; s < kStreamCount; ++s) sink.offset[s] = offsets[s * round.kernel.items.size() + i];
    round.visit(i, sink);
  }
};

/// The tree, its bounds and motion classes on the device.
struct Input {
  BvhView tree;
  DeviceArray<BvhChildren> children;
  DeviceArray<std::uint32_t> component_of, motion_class;
  DeviceArray<Kdop16> bounds;

  FrontSproutKernel kernel() const {
    FrontSproutKernel k{tree, bounds.view(), motion_class.view(), {}};
    k.tree.children = children.view();
    k.tree.component_of = component_of.view();
    return k;
  }
};

class CudaAppender final : public DeviceAppender {
 public:
  CudaAppender(AppendVariant variant, std::size_t capacity) : variant_(variant) {
    for (std::size_t s = 0; s < kStreamCount; ++s) buffers_.emplace_back(queue_, std::max<std::size_t>(capacity, 1));
  }

  void set_input(const FrontSproutKernel& kernel) override {
    input_.tree = kernel.tree;
    input_.children = DeviceArray<BvhChildren>(queue_, kernel.tree.children);
    input_.component_of = DeviceArray<std::uint32_t>(queue_, kernel.tree.component_of);
    input_.motion_class = DeviceArray<std::uint32_t>(queue_, kernel.motion_class);
    input_.bounds = DeviceArray<Kdop16>(queue_, kernel.bounds);
  }

  double run(Span<const std::uint64_t> items) override {
    replays_ = 0;
    for (std::vector<std::uint64_t>& stream : streams_) stream.clear();
    double ms = 0;
    std::vector<std::uint64_t> left(items.begin(), items.end());
    for (bool first = true; !left.empty(); first = false) {
      const DeviceArray<std::uint64_t> of_round(queue_, Span<const std::uint64_t>(left));
      FrontRound round{input_.kernel(), first};
      round.kernel.items = of_round.view();
      StageClock clock;
      variant_ == AppendVariant::CountScanEmit ? count_scan_emit(round) : append(round);
      ms += clock.total();
      collect();
      left = std::exchange(streams_[Stream::Pending], {});
    }
    return ms;
  }

  std::vector<std::uint64_t> values(Stream stream) const override { return streams_[stream]; }
  int replays() const override { return replays_; }

 private:
  void append(const FrontRound& round) {
    const std::size_t count = round.kernel.items.size();
    for (bool full = true; full;) {
      StreamViews views;
      for (std::size_t s = 0; s < kStreamCount; ++s) views.stream[s] = buffers_[s].start();
      if (variant_ == AppendVariant::GlobalLock) {
        queue_.launch(count, SproutWithGlobalLock{round, views});
      } else {
        const auto blocks = static_cast<unsigned>((count + kThreadsPerBlock - 1) / kThreadsPerBlock);
        sprout_with_local_lock<<<blocks, kThreadsPerBlock, 0, queue_.stream()>>>(round, views);
        check_cuda(cudaGetLastError(), "a kernel's launch");
      }
      full = false;
      for (DeviceAppendBuffer<std::uint64_t>& buffer : buffers_) full = buffer.grown() || full;
      replays_ += full ? 1 : 0;
    }
  }

  void count_scan_emit(const FrontRound& round) {
    const std::size_t count = round.kernel.items.size(), cells = kStreamCount * count;
    DeviceArray<std::uint64_t> counts(queue_, cells + 1);
    DeviceArray<std::uint64_t> offsets(queue_, cells + 1);
    const std::uint64_t none = 0;  // so that the last offset is the total
    queue_.copy_up(counts.view().data() + cells, &none, sizeof none);
    queue_.launch(count, CountValues{round, counts.view()});
    std::size_t bytes = 0;
    check_cuda(cub::DeviceScan::ExclusiveSum(nullptr, bytes, counts.view().data(), offsets.view().data(), cells + 1,
                                             queue_.stream()),
               "the scan");
    DeviceArray<std::byte> scratch(queue_, bytes);
    check_cuda(cub::DeviceScan::ExclusiveSum(scratch.view().data(), bytes, counts.view().data(), offsets.view().data(),
                                             cells + 1, queue_.stream()),
               "the scan");
    std::uint64_t begins[kStreamCount + 1] = {};
    for (std::size_t s = 0; s <= kStreamCount; ++s)
      queue_.copy_down(&begins[s], offsets.view().data() + s * count, sizeof begins[s]);
    queue_.wait();
    std::copy(std::begin(begins), std::end(begins), begins_.begin());
    emitted_ = DeviceArray<std::uint64_t>(queue_, begins_[kStreamCount]);
    queue_.launch(count, EmitValues{round, offsets.view(), emitted_.view()});
    queue_.wait();
  }

  /// Copies the values of a round to the host.
  void collect() {
    std::vector<std::uint64_t> all;
    if (variant_ == AppendVariant::CountScanEmit) all = brought_down(queue_, emitted_, begins_[kStreamCount]);
    for (std::size_t s = 0; s < kStreamCount; ++s) {
      std::vector<std::uint64_t> found;
      if (variant_ == AppendVariant::CountScanEmit) {
        found.assign(all.begin() + static_cast<std::ptrdiff_t>(begins_[s]),
                     all.begin() + static_cast<std::ptrdiff_t>(begins_[s + 1]));
      } else {
        found = buffers_[s].values();
      }
      streams_[s].insert(streams_[s].end(), found.begin(), found.end());
    }
  }

  AppendVariant variant_;
  CudaQueue queue_;
  Input input_;
  std::vector<DeviceAppendBuffer<std::uint64_t>> buffers_;
  DeviceArray<std::uint64_t> emitted_;                    // one stream after the other
  std::array<std::uint64_t, kStreamCount + 1> begins_{};  // of each in that
  std::array<std::vector<std::uint64_t>, kStreamCount> streams_;
  int replays_ = 0;
};

}  // namespace

Result<std::unique_ptr<DeviceAppender>> make_device_appender(AppendVariant variant, std::size_t capacity) {
  const Result<std::string> device = cuda_device_name();
  if (!device) return device.error();
  return std::unique_ptr<DeviceAppender>(std::make_unique<CudaAppender>(variant, capacity));
}

}  // namespace dismantle
