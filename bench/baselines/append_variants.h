// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/append_buffer.h"
#include "dismantle/exec/executor.h"
#include "dismantle/front/front_kernel.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace dismantle {

/// How threads that find things at the same time put them into one stream.
enum class AppendVariant {
  GlobalLock,     ///< One atomic addition a value, on the stream's own counter (Du et al. 2015, section 4.3).
  LocalLock,      ///< Into a buffer of the group of items first, which goes to the stream when it is full, with one
                  ///< atomic addition (Tang, Manocha, Lin, Tong 2011). What `streams` does.
  CountScanEmit,  ///< Everything is found twice: counted, and written where a prefix sum of the counts says.
};

inline constexpr AppendVariant kAppendVariants[] = {AppendVariant::GlobalLock, AppendVariant::LocalLock,
                                                    AppendVariant::CountScanEmit};

/// "global lock", "local lock", "count-scan-emit".
std::string_view name_of(AppendVariant variant);

/// Looks at the nodes of a front as `Front` does, with every way of appending: what comes out is the same.
class FrontAppender {
 public:
  /// What a launch appends to.
  enum Stream : std::size_t { TrianglePairs, Kept, Rested, Sprouted, Pending, kStreamCount };

  /// @param capacity that the streams start with; they grow as needed, and the launch is run again
  FrontAppender(AppendVariant variant, std::size_t capacity);

  /// Looks at `kernel.items`, and in further rounds at what they leave over.
  void run(FrontSproutKernel kernel, const Executor& executor);

  /// What the last run put into the stream, in no particular order; Pending is empty then.
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
