// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace dismantle {

/// Cores that all programs kept busy during the next `seconds`, in which this one sleeps; 0 where the system does not
/// say (Linux: /proc/stat).
double busy_cores(double seconds);

/// The processor's name, as the system knows it.
std::string processor_name();

}  // namespace dismantle
