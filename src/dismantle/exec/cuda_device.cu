// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/cuda_device.h"

#include <cuda_runtime.h>

namespace dismantle {

Result<std::string> cuda_device_name() {
  int count = 0;
  const cudaError_t counted = cudaGetDeviceCount(&count);
  if (counted != cudaSuccess) return Error{ErrorKind::Failed, cudaGetErrorString(counted)};
  if (count == 0) return Error{ErrorKind::Failed, "there is no CUDA device"};
  cudaDeviceProp properties{};
  const cudaError_t status = cudaGetDeviceProperties(&properties, 0);
  if (status != cudaSuccess) return Error{ErrorKind::Failed, cudaGetErrorString(status)};
  return std::string(properties.name);
}

}  // namespace dismantle
