// SPDX-License-Identifier: Apache-2.0
// What *_cuda.cu have, where they are not built.
#include "dismantle/exec/cuda_device.h"
#include "dismantle/front/front_device.h"

namespace dismantle {

Result<std::unique_ptr<FrontDevice>> make_cuda_front_device(std::size_t) {
  return cuda_device_name().error();
}

}  // namespace dismantle
