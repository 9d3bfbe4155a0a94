// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/executor.h"

#include <optional>
#include <ostream>

namespace dismantle {

/// A device that tests run on: the CUDA device, or its emulation by an executor of the host.
struct TestedDevice {
  const char* name;
  std::optional<Executor> emulated_by;  ///< None for the CUDA device.
  friend std::ostream& operator<<(std::ostream& out, const TestedDevice& device) { return out << device.name; }
};

}  // namespace dismantle
