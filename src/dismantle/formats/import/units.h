// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <string_view>

namespace dismantle {

/// Millimetres per unit, for "mm", "cm", "m", "um", "in" or "ft". Errors: Usage for any other name.
Result<double> millimetres_per_unit(std::string_view units);

}  // namespace dismantle
