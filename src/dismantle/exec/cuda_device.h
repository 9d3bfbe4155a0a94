// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <stdexcept>
#include <string>

namespace dismantle {

/// A CUDA call that failed while kernels were at work: the device was lost or its memory is used up.
class CudaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The name of the CUDA device that is used, the first one. Errors: Failed where this build has no CUDA, or where there
/// is no device or driver; the message has the reason only, for a sentence of the caller.
Result<std::string> cuda_device_name();

}  // namespace dismantle
