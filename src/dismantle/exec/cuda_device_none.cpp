// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/cuda_device.h"

namespace dismantle {

Result<std::string> cuda_device_name() {
  return Error{ErrorKind::Failed, "this build has no CUDA"};
}

}  // namespace dismantle
