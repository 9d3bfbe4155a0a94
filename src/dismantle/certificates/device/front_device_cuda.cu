// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/device/device_fronts.h"
#include "dismantle/exec/cuda_queue.cuh"

namespace dismantle {

Result<std::unique_ptr<FrontDevice>> make_cuda_front_device(std::size_t capacity) {
  const Result<std::string> device = cuda_device_name();
  if (!device) return device.error();
  try {
    return std::unique_ptr<FrontDevice>(std::make_unique<DeviceFronts<CudaQueue>>(CudaQueue(), capacity));
  } catch (const CudaError& error) {
    return Error{ErrorKind::Failed, error.what()};
  }
}

}  // namespace dismantle
