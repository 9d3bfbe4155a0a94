// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/append_variants.h"

#include <utility>

namespace dismantle {

namespace {

constexpr std::size_t kNodesPerRange = 2048;  // as in Front: the group of the local lock
constexpr std::size_t kPendingPerRange = 4;

using Stream = FrontAppender::Stream;
constexpr std::size_t kStreamCount = FrontAppender::kStreamCount;
using Views = std::array<AppendView<std::uint64_t>, kStreamCount>;
using Offsets = std::array<std::size_t, kStreamCount>;

/// The sink of the kernel: passes each value on to `Derived::put(stream, value)`.
template <class Derived>
class StreamSink {
 public:
  void sprout(std::size_t index) { put(Stream::Sprouted, index); }
  void keep(std::uint64_t key) { put(Stream::Kept, key); }
  void rest(std::uint64_t key) { put(Stream::Rested, key); }
  void triangle_pair(std::uint64_t key) { put(Stream::TrianglePairs, key); }
  void pend(std::uint64_t key) { put(Stream::Pending, key); }

 private:
  void put(Stream stream, std::uint64_t value) { static_cast<Derived*>(this)->put(stream, value); }
};

class GlobalLockSink : public StreamSink<GlobalLockSink> {
 public:
  explicit GlobalLockSink(const Views& views) : views_(views) {}
  void put(Stream stream, std::uint64_t value) { views_[stream].append(value); }

 private:
  const Views& views_;
};

class LocalLockSink : public StreamSink<LocalLockSink> {
 public:
  explicit LocalLockSink(const Views& v)
      : staged_{StagedAppend<std::uint64_t>(v[0]), StagedAppend<std::uint64_t>(v[1]), StagedAppend<std::uint64_t>(v[2]),
                StagedAppend<std::uint64_t>(v[3]), StagedAppend<std::uint64_t>(v[4])} {}
  void put(Stream stream, std::uint64_t value) { staged_[stream].append(value); }

 private:
  StagedAppend<std::uint64_t> staged_[kStreamCount];
};

class CountSink : public StreamSink<CountSink> {
 public:
  explicit CountSink(Offsets& counts) : counts_(counts) {}
  void put(Stream stream, std::uint64_t) { ++counts_[stream]; }

 private:
  Offsets& counts_;
};

class EmitSink : public StreamSink<EmitSink> {
 public:
  EmitSink(std::array<std::vector<std::uint64_t>, kStreamCount>& streams, const Offsets& offsets)
      : streams_(streams), offsets_(offsets) {}
  void put(Stream stream, std::uint64_t value) { streams_[stream][offsets_[stream]++] = value; }

 private:
  std::array<std::vector<std::uint64_t>, kStreamCount>& streams_;
  Offsets offsets_;
};

}  // namespace

std::string_view name_of(AppendVariant variant) {
  switch (variant) {
    case AppendVariant::GlobalLock:
      return "global lock";
    case AppendVariant::WarpAggregated:
      return "warp-aggregated";
    case AppendVariant::LocalLock:
      return "local lock";
    case AppendVariant::CountScanEmit:
      return "count-scan-emit";
  }
  return "";
}

FrontAppender::FrontAppender(AppendVariant variant, std::size_t capacity)
    : variant_(variant),
      buffers_{AppendBuffer<std::uint64_t>(capacity), AppendBuffer<std::uint64_t>(capacity),
               AppendBuffer<std::uint64_t>(capacity), AppendBuffer<std::uint64_t>(capacity),
               AppendBuffer<std::uint64_t>(capacity)} {}

void FrontAppender::run(FrontSproutKernel kernel, const Executor& executor) {
  for (std::vector<std::uint64_t>& stream : streams_) stream.clear();
  launch(
      kernel.items.size(), kNodesPerRange, [&](std::size_t i, auto& sink) { kernel.sprout_node(i, sink); }, executor);
  while (!streams_[Pending].empty()) {
    const std::vector<std::uint64_t> left = std::exchange(streams_[Pending], {});
    kernel.items = left;
    launch(
        left.size(), kPendingPerRange, [&](std::size_t i, auto& sink) { kernel.resume(i, sink); }, executor);
  }
}

template <class Item>
void FrontAppender::launch(std::size_t count, std::size_t items_per_range, const Item& item, const Executor& executor) {
  if (variant_ == AppendVariant::CountScanEmit) {
    count_scan_emit(count, items_per_range, item, executor);
  } else if (variant_ == AppendVariant::GlobalLock || variant_ == AppendVariant::WarpAggregated) {
    append<GlobalLockSink>(count, items_per_range, item, executor);
  } else {
    append<LocalLockSink>(count, items_per_range, item, executor);
  }
}

template <class Sink, class Item>
void FrontAppender::append(std::size_t count, std::size_t items_per_range, const Item& item, const Executor& executor) {
  for (bool full = true; full;) {
    Views views;
    for (std::size_t s = 0; s < kStreamCount; ++s) views[s] = buffers_[s].start();
    executor.for_each_range(count, items_per_range, [&](std::size_t begin, std::size_t end) {
      Sink sink(views);
      for (std::size_t i = begin; i < end; ++i) item(i, sink);
    });
    full = false;
    for (AppendBuffer<std::uint64_t>& buffer : buffers_) {
      if (!buffer.overflowed()) continue;
      buffer.grow();
      full = true;
    }
  }
  for (std::size_t s = 0; s < kStreamCount; ++s) {
    const Span<const std::uint64_t> values = std::as_const(buffers_[s]).values();
    streams_[s].insert(streams_[s].end(), values.begin(), values.end());
  }
}

template <class Item>
void FrontAppender::count_scan_emit(std::size_t count, std::size_t items_per_range, const Item& item,
                                    const Executor& executor) {
  std::vector<Offsets> offsets((count + items_per_range - 1) / items_per_range);
  executor.for_each_range(count, items_per_range, [&](std::size_t begin, std::size_t end) {
    CountSink sink(offsets[begin / items_per_range]);
    for (std::size_t i = begin; i < end; ++i) item(i, sink);
  });
  for (std::size_t s = 0; s < kStreamCount; ++s) {
    std::size_t next = streams_[s].size();
    for (Offsets& range : offsets) next += std::exchange(range[s], next);
    streams_[s].resize(next);
  }
  executor.for_each_range(count, items_per_range, [&](std::size_t begin, std::size_t end) {
    EmitSink sink(streams_, offsets[begin / items_per_range]);
    for (std::size_t i = begin; i < end; ++i) item(i, sink);
  });
}

}  // namespace dismantle
