// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/csv_text.h"

#include <charconv>
#include <cmath>
#include <iterator>

namespace dismantle {

namespace {

constexpr int kDigits = 9;

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

std::string csv_field(double number) {
  if (!std::isfinite(number)) return {};
  char buffer[32];
  const double plain = number == 0 ? 0 : number;  // no "-0"
  const auto [end, error] =
      std::to_chars(std::begin(buffer), std::end(buffer), plain, std::chars_format::general, kDigits);
  DISMANTLE_ENSURE(error == std::errc{});
  return {buffer, end};
}

std::string csv_field(std::size_t number) {
  return std::to_string(number);
}

std::string csv_row(const std::vector<std::string>& fields) {
  return joined(fields, ",") + "\r\n";
}

std::string joined(Span<const std::string> texts, std::string_view between) {
  std::string result;
  for (const std::string& text : texts) {
    if (&text != texts.data()) result += between;
    result += text;
  }
  return result;
}

}  // namespace dismantle
