// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/streams_backend.h"
#include "dismantle/exec/cuda_device.h"

namespace dismantle {

Result<std::unique_ptr<StreamsBackend>> make_cuda_streams_backend(const Assembly&, const CollisionOptions&) {
  return cuda_device_name().error();
}

}  // namespace dismantle
