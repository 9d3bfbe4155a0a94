// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/device_appender.h"
#include "dismantle/exec/cuda_device.h"

namespace dismantle {

Result<std::unique_ptr<DeviceAppender>> make_device_appender(AppendVariant, std::size_t) {
  return cuda_device_name().error();
}

}  // namespace dismantle
