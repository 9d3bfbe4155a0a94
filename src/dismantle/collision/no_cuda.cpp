// SPDX-License-Identifier: Apache-2.0
// What *_cuda.cu have, where they are not built.
#include "dismantle/collision/front_device.h"
#include "dismantle/collision/motion_batch.h"
#include "dismantle/collision/streams_backend.h"
#include "dismantle/exec/cuda_device.h"

namespace dismantle {

Result<std::unique_ptr<FrontDevice>> make_cuda_front_device(std::size_t) {
  return cuda_device_name().error();
}

Result<std::unique_ptr<StreamsBackend>> make_cuda_streams_backend(const Assembly&, const CollisionOptions&) {
  return cuda_device_name().error();
}

Result<std::unique_ptr<MotionBatch>> make_cuda_motion_batch(const Assembly&, const PairStates&, const Executor&) {
  return cuda_device_name().error();
}

}  // namespace dismantle
