// SPDX-License-Identifier: Apache-2.0
// What the CUDA file beside this one has, where that is not built.
#include "dismantle/exec/cuda_device.h"
#include "dismantle/streams/streams_backend.h"

namespace dismantle {

Result<std::unique_ptr<StreamsBackend>> make_cuda_streams_backend(const Assembly&, const CollisionOptions&) {
  return cuda_device_name().error();
}

}  // namespace dismantle
