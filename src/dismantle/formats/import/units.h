// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <string>
#include <string_view>

namespace dismantle {

/// Millimetres per unit, for "mm", "cm", "m", "um", "in" or "ft". Errors: Usage for any other name.
Result<double> millimetres_per_unit(std::string_view units);

/// The length unit of a file.
struct LengthUnit {
  double millimetres = 1;   ///< Per unit.
  std::string name = "mm";  ///< One that millimetres_per_unit knows, or a number of millimetres.
};

/// The unit of that many millimetres; mm unless the number is positive and finite. Numbers within 1e-6 of a known unit
/// are that unit.
LengthUnit length_unit_of(double millimetres);

}  // namespace dismantle
