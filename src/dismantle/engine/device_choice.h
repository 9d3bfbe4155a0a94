// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle {

/// Where a method is to be computed.
enum class DeviceChoice {
  Cpu,
  Cuda,  ///< The CPU all the same where there is no CUDA device.
  Auto,  ///< CUDA where there is a device and the work is worth it.
};

}  // namespace dismantle
