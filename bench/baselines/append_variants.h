// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/append_buffer.h"
#include "dismantle/exec/executor.h"
#include "dismantle/streams/bvtt_front_kernel.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace dismantle {

/// Ways in which concurrent threads append values to one stream.
enum class AppendVariant {
  GlobalLock,      ///< One atomic addition for each value, on the stream's own counter (Du et al. 2015, section 4.3).
  LocalLock,       ///< Into a buffer local to a group of items, which is flushed to the stream with one atomic addition
                   ///< when it is full (Tang, Manocha, Lin, Tong 2011). Method `streams` does this.
  WarpAggregated,  ///< As GlobalLock, with one addition for the threads of a warp that append together; on a CPU the
                   ///< same.
  CountScanEmit,   ///< Two passes: the first counts, the second writes to the offsets of a prefix sum of the counts.
};

///@{ All variants that differ on a CPU, and on a CUDA device.
inline constexpr AppendVariant kAppendVariants[] = {AppendVariant::GlobalLock, AppendVariant::LocalLock,
                                                    AppendVariant::CountScanEmit};
inline constexpr AppendVariant kDeviceAppendVariants[] = {AppendVariant::GlobalLock, AppendVariant::WarpAggregated,
                                                          AppendVariant::LocalLock, AppendVariant::CountScanEmit};
///@}

/// "global lock", "local lock", "warp-aggregated", "count-scan-emit".
std::string_view name_of(AppendVariant variant);

/// Sprouts the nodes of a front as `Front` does, with any of the variants: the values appended are the same.
class FrontAppender {
 public:
  /// The streams that a launch appends to.
  enum Stream : std::size_t { TrianglePairs, Kept, Rested, Sprouted, Pending, kStreamCount };

  /// @param capacity initial size of the streams [values]; they grow as needed, and the launch is repeated
  FrontAppender(AppendVariant variant, std::size_t capacity);

  /// Sprouts `kernel.items`, and in further rounds the items that were left pending.
  void run(FrontSproutKernel kernel, const Executor& executor);

  /// The values that the last run appended to the stream, in no particular order; Pending is empty.
  Span<const std::uint64_t> values(Stream stream) const { return streams_[stream]; }

 private:
  template <class Item>
  void launch(std::size_t count, std::size_t items_per_range, const Item& item, const Executor& executor);
  template <class Sink, class Item>
  void append(std::size_t count, std::size_t items_per_range, const Item& item, const Executor& executor);
  template <class Item>
  void count_scan_emit(std::size_t count, std::size_t items_per_range, const Item& item, const Executor& executor);

  AppendVariant variant_;
  std::array<AppendBuffer<std::uint64_t>, kStreamCount> buffers_;
  std::array<std::vector<std::uint64_t>, kStreamCount> streams_;
};

}  // namespace dismantle
