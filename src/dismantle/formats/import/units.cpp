// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/units.h"

#include <cmath>
#include <string>
#include <utility>

namespace dismantle {

Result<double> millimetres_per_unit(std::string_view units) {
  constexpr std::pair<std::string_view, double> kUnits[] = {{"mm", 1},     {"cm", 10},   {"m", 1000},
                                                            {"um", 0.001}, {"in", 25.4}, {"ft", 304.8}};
  for (const auto& [name, millimetres] : kUnits)
    if (name == units) return millimetres;
  return Error{ErrorKind::Usage, "unknown unit \"" + std::string(units) +
                                     "\" (dismantle knows mm, cm, m, um, in and ft); name one of these"};
}

LengthUnit length_unit_of(double millimetres) {
  constexpr double kSame = 1e-6;
  if (!(millimetres > 0) || !std::isfinite(millimetres)) return {};
  for (const char* name : {"mm", "cm", "m", "um", "in", "ft"})
    if (std::abs(*millimetres_per_unit(name) / millimetres - 1) < kSame) return {*millimetres_per_unit(name), name};
  return {millimetres, std::to_string(millimetres) + " mm"};
}

}  // namespace dismantle
