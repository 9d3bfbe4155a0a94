// SPDX-License-Identifier: Apache-2.0
#include "dismantle/candidates/device_batch.h"
#include "dismantle/exec/cuda_queue.cuh"

namespace dismantle {

Result<std::unique_ptr<MotionBatch>> make_cuda_motion_batch(const Assembly& assembly, const PairStates& pairs,
                                                            const Executor& executor) {
  const Result<std::string> device = cuda_device_name();
  if (!device) return device.error();
  try {
    return std::unique_ptr<MotionBatch>(
        std::make_unique<DeviceBatch<CudaQueue>>(CudaQueue(), assembly, pairs, executor));
  } catch (const CudaError& error) {
    return Error{ErrorKind::Failed, error.what()};
  }
}

}  // namespace dismantle
