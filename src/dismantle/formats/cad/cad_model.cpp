// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/cad_model.h"

#include "dismantle/formats/import/units.h"

#include <cmath>

namespace dismantle {

LengthUnit length_unit_of(double millimetres) {
  if (!(millimetres > 0) || !std::isfinite(millimetres)) return {};
  for (const char* name : {"mm", "cm", "m", "um", "in", "ft"})
    if (std::abs(*millimetres_per_unit(name) / millimetres - 1) < 1e-9) return {*millimetres_per_unit(name), name};
  return {millimetres, std::to_string(millimetres) + " mm"};
}

}  // namespace dismantle
