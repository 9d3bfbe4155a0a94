// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/cuda_queue.cuh"
#include "dismantle/front/resident_fronts.h"

namespace dismantle {

namespace {

/// What buffers have room for at first: the pages and pairs of a front of some thousand pairs.
constexpr std::size_t kFirstCapacity = 1024;

}  // namespace

Result<std::unique_ptr<FrontDevice>> make_cuda_front_device() {
  const Result<std::string> device = cuda_device_name();
  if (!device) return device.error();
  try {
    return std::unique_ptr<FrontDevice>(std::make_unique<ResidentFronts<CudaQueue>>(CudaQueue(), kFirstCapacity));
  } catch (const CudaError& error) {
    return Error{ErrorKind::Failed, error.what()};
  }
}

}  // namespace dismantle
