// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/baselines/append_variants.h"
#include "dismantle/core/result.h"

#include <memory>
#include <vector>

namespace dismantle {

/// FrontAppender on a CUDA device: groups are blocks of threads, and their buffers lie in the memory that a block
/// shares.
class DeviceAppender {
 public:
  virtual ~DeviceAppender() = default;

  /// What launches look at from now on, but for its items. @param kernel views of host memory
  virtual void set_input(const FrontSproutKernel& kernel) = 0;
  /// Looks at the items, and in further rounds at what they leave over.
  /// @return wall time from when the items are on the device until everything is appended there [ms]
  virtual double run(Span<const std::uint64_t> items) = 0;
  /// What the last run put into the stream, in no particular order; Pending is empty then.
  virtual std::vector<std::uint64_t> values(FrontAppender::Stream stream) const = 0;
  /// How often the last run launched again because something was full.
  virtual int replays() const = 0;
};

/// @param capacity that the streams start with
/// Errors: Failed with the reason alone where there is no CUDA device, or this build has no CUDA.
Result<std::unique_ptr<DeviceAppender>> make_device_appender(AppendVariant variant, std::size_t capacity);

}  // namespace dismantle
