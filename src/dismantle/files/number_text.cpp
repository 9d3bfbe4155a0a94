// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/number_text.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace dismantle {

std::string number_text(double value, int digits, double resolution) {
  DISMANTLE_EXPECT(std::isfinite(value) && digits > 0 && resolution > 0);
  if (value == 0) return "0";
  const int last_place = static_cast<int>(std::lround(std::log10(resolution)));  // exponent of ten of the last digit
  const int first_place = static_cast<int>(std::floor(std::log10(std::abs(value))));
  const int place = std::max(last_place, first_place - digits + 1);
  if (place > first_place + 1) return "0";
  const double unit = std::pow(10.0, std::abs(place));
  const double rounded = place > 0 ? std::round(value / unit) * unit : std::round(value * unit) / unit;
  std::array<char, 400> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), rounded, std::chars_format::fixed, std::max(0, -place));
  DISMANTLE_ENSURE(error == std::errc());
  std::string result(text.data(), end);
  if (result.find('.') != std::string::npos) {
    result.erase(result.find_last_not_of('0') + 1);
    if (result.back() == '.') result.pop_back();
  }
  return result == "-0" ? "0" : result;
}

std::string count_text(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace dismantle
