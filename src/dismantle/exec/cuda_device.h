// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <stdexcept>
#include <string>

namespace dismantle {

/// The exception for a CUDA call that failed while kernels ran: the device was lost or is out of memory.
class CudaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Why a device was given up in the middle of its work; the rest is then computed on the CPU, with the same results.
/// Shared by what uses the device and what tells the user.
struct DeviceFailure {
  std::string why;  ///< Empty while the device works.
};

/// The name of the CUDA device that is used, the first one. Errors: Failed if this build has no CUDA, or there is no
/// device or driver; the message is the reason only, for the caller's sentence.
Result<std::string> cuda_device_name();

}  // namespace dismantle
