// SPDX-License-Identifier: Apache-2.0
// What the CUDA file beside this one has, where that is not built.
#include "dismantle/certificates/device/front_device.h"
#include "dismantle/exec/cuda_device.h"

namespace dismantle {

Result<std::unique_ptr<FrontDevice>> make_cuda_front_device(std::size_t) {
  return cuda_device_name().error();
}

}  // namespace dismantle
