// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/baselines/append_variants.h"
#include "dismantle/core/result.h"

#include <memory>
#include <vector>

namespace dismantle {

/// FrontAppender on a CUDA device: groups are blocks of threads, and their buffers lie in the block's shared memory.
class DeviceAppender {
 public:
  virtual ~DeviceAppender() = default;

  /// Copies the tree, bounds and motion classes of the kernel to the device for the following runs; not its items.
  /// @param kernel views of host memory
  virtual void set_input(const FrontSproutKernel& kernel) = 0;
  /// Sprouts the items, and in further rounds those that were left pending.
  /// @return wall time from when the items are on the device until everything is appended there [ms]
  virtual double run(Span<const std::uint64_t> items) = 0;
  /// The values that the last run appended to the stream, in no particular order; Pending is empty.
  virtual std::vector<std::uint64_t> values(FrontAppender::Stream stream) const = 0;
  /// The number of launches of the last run that were repeated because a stream was full.
  virtual int replays() const = 0;
};

/// Makes the appender of a variant. @param capacity initial size of the streams [values]
/// Errors: Failed with the reason alone where there is no CUDA device, or this build has no CUDA.
Result<std::unique_ptr<DeviceAppender>> make_device_appender(AppendVariant variant, std::size_t capacity);

}  // namespace dismantle
