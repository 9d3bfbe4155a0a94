// SPDX-License-Identifier: Apache-2.0
// Stands for the CUDA file beside it in builds without CUDA.
#include "dismantle/exec/cuda_device.h"
#include "dismantle/streams/streams_backend.h"

namespace dismantle {

Result<std::unique_ptr<StreamsBackend>> make_cuda_streams_backend(const Assembly&, const CollisionOptions&) {
  return cuda_device_name().error();
}

}  // namespace dismantle
