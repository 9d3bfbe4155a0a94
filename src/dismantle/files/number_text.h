// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace dismantle {

/// A number for people: at most `digits` significant digits, no digit below `resolution`, no exponent and no trailing
/// zeros. "0" where nothing is left of it, also for -0; digits before the decimal point are rounded to zeros, but never
/// dropped: 743384 with 4 digits is "743400".
/// @param resolution in the unit of the number: the last place that means something; rounded to a power of ten
/// @pre value is finite, digits > 0, resolution > 0
std::string number_text(double value, int digits, double resolution = 1e-6);

/// "1 step", "2 steps".
std::string count_text(std::size_t count, const std::string& noun);

}  // namespace dismantle
