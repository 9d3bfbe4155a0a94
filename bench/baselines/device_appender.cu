// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/device_appender.h"

#include "bench/baselines/device_append_buffer.cuh"

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

/// Appends every value with an atomic addition of its own, or with one for the threads of a warp that append together.
template <bool kTogether>
class GlobalLockSink : public DeviceSink<GlobalLockSink<kTogether>> {
 public:
  __device__ explicit GlobalLockSink(const StreamViews& views) : views_(views) {}
  __device__ void put(Stream stream, std::uint64_t value) {
    kTogether ? views_.stream[stream].append_together(value) : views_.stream[stream].append(value);
  }

 private:
  const StreamViews& views_;
};

template <bool kTogether>
struct SproutWithGlobalLock {
  FrontRound round;
  StreamViews views;

  __device__ void operator()(std::size_t i) const {
    GlobalLockSink<kTogether> sink(views);
    round.visit(i, sink);
  }
};

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
      FrontRound round{input_.kernel(), first};
      round.kernel.items = upload(queue_, items_, Span<const std::uint64_t>(left));
      round.kernel.work_budget = kDeviceFrontWorkBudget;
      ms += variant_ == AppendVariant::CountScanEmit ? count_scan_emit(round) : append(round);
      collect();
      left = std::exchange(streams_[Stream::Pending], {});
    }
    return ms;
  }

  std::vector<std::uint64_t> values(Stream stream) const override { return streams_[stream]; }
  int replays() const override { return replays_; }

 private:
  /// @return the time of the kernels [ms]
  double append(const FrontRound& round) {
    const std::size_t count = round.kernel.items.size();
    double ms = 0;
    for (bool full = true; full;) {
      StreamViews views;
      for (std::size_t s = 0; s < kStreamCount; ++s) views.stream[s] = buffers_[s].start();
      queue_.mark(0);
      if (variant_ == AppendVariant::GlobalLock) {
        queue_.launch(count, SproutWithGlobalLock<false>{round, views});
      } else if (variant_ == AppendVariant::WarpAggregated) {
        queue_.launch(count, SproutWithGlobalLock<true>{round, views});
      } else {
        const auto blocks = static_cast<unsigned>((count + kThreadsPerBlock - 1) / kThreadsPerBlock);
        sprout_with_local_lock<<<blocks, kThreadsPerBlock, 0, queue_.stream()>>>(round, views);
        check_cuda(cudaGetLastError(), "a kernel's launch");
      }
      queue_.mark(1);
      full = false;
      for (DeviceAppendBuffer<std::uint64_t>& buffer : buffers_) full = buffer.grown() || full;
      replays_ += full ? 1 : 0;
      ms += queue_.milliseconds(0, 1);
    }
    return ms;
  }

  /// @return the time of the kernels [ms], without that of the host in between, which learns the number of values
  double count_scan_emit(const FrontRound& round) {
    const std::size_t count = round.kernel.items.size(), cells = kStreamCount * count;
    const Span<std::uint64_t> counts = room_for(queue_, counts_, cells + 1);
    const Span<std::uint64_t> offsets = room_for(queue_, offsets_, cells + 1);
    const auto scan = [&](void* scratch, std::size_t& bytes) {
      check_cuda(
          cub::DeviceScan::ExclusiveSum(scratch, bytes, counts.data(), offsets.data(), cells + 1, queue_.stream()),
          "the scan");
    };
    std::size_t bytes = 0;
    scan(nullptr, bytes);
    const Span<std::byte> scratch = room_for(queue_, scratch_, bytes);
    const std::uint64_t none = 0;  // so that the last offset is the total
    queue_.copy_up(counts.data() + cells, &none, sizeof none);
    queue_.wait();
    queue_.mark(0);
    queue_.launch(count, CountValues{round, counts});
    scan(scratch.data(), bytes);
    queue_.mark(1);
    std::uint64_t begins[kStreamCount + 1] = {};
    for (std::size_t s = 0; s <= kStreamCount; ++s)
      queue_.copy_down(&begins[s], offsets.data() + s * count, sizeof begins[s]);
    queue_.wait();
    std::copy(std::begin(begins), std::end(begins), begins_.begin());
    const Span<std::uint64_t> emitted = room_for(queue_, emitted_, begins_[kStreamCount]);
    queue_.mark(2);
    queue_.launch(count, EmitValues{round, offsets, emitted});
    queue_.mark(3);
    queue_.wait();
    return queue_.milliseconds(0, 1) + queue_.milliseconds(2, 3);
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
  DeviceArray<std::uint64_t> items_, counts_, offsets_;
  DeviceArray<std::byte> scratch_;
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
