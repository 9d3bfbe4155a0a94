// SPDX-License-Identifier: Apache-2.0
// What the CUDA file beside this one has, where that is not built.
#include "dismantle/candidates/motion_batch.h"
#include "dismantle/exec/cuda_device.h"

namespace dismantle {

Result<std::unique_ptr<MotionBatch>> make_cuda_motion_batch(const Assembly&, const PairStates&, const Executor&) {
  return cuda_device_name().error();
}

}  // namespace dismantle
