// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle {

/// The device that a method runs on.
enum class DeviceChoice {
  Cpu,   ///< Threads of the CPU.
  Cuda,  ///< The CUDA device; the CPU if there is none.
  Auto,  ///< The CUDA device if there is one and there is enough work for it.
};

}  // namespace dismantle
