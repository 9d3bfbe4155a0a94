// SPDX-License-Identifier: Apache-2.0
// Replaces front_device_cuda.cu in builds without CUDA.
#include "dismantle/certificates/device/front_device.h"
#include "dismantle/exec/cuda_device.h"

namespace dismantle {

Result<std::unique_ptr<FrontDevice>> make_cuda_front_device(std::size_t) {
  return cuda_device_name().error();
}

}  // namespace dismantle
