// SPDX-License-Identifier: Apache-2.0
// Stands for the CUDA file beside it in builds without CUDA.
#include "dismantle/candidates/motion_batch.h"
#include "dismantle/exec/cuda_device.h"

namespace dismantle {

Result<std::unique_ptr<MotionBatch>> make_cuda_motion_batch(const Assembly&, const PairStates&, const Executor&) {
  return cuda_device_name().error();
}

}  // namespace dismantle
