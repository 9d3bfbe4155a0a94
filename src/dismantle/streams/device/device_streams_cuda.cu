// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/cuda_queue.cuh"
#include "dismantle/streams/device/device_streams_backend.h"

namespace dismantle {

Result<std::unique_ptr<StreamsBackend>> make_cuda_streams_backend(const Assembly& assembly,
                                                                  const CollisionOptions& options) {
  const Result<std::string> device = cuda_device_name();
  if (!device) return device.error();
  try {
    return std::unique_ptr<StreamsBackend>(
        std::make_unique<DeviceStreamsBackend<CudaQueue>>(CudaQueue(), assembly, options));
  } catch (const CudaError& error) {
    return Error{ErrorKind::Failed, error.what()};
  }
}

}  // namespace dismantle
