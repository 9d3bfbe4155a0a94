// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/resident_streams_backend.h"
#include "dismantle/exec/cuda_queue.cuh"

namespace dismantle {

Result<std::unique_ptr<StreamsBackend>> make_cuda_streams_backend(const Assembly& assembly,
                                                                  const CollisionOptions& options) {
  const Result<std::string> device = cuda_device_name();
  if (!device) return device.error();
  try {
    return std::unique_ptr<StreamsBackend>(
        std::make_unique<ResidentStreamsBackend<CudaQueue>>(CudaQueue(), assembly, options));
  } catch (const CudaError& error) {
    return Error{ErrorKind::Failed, error.what()};
  }
}

}  // namespace dismantle
