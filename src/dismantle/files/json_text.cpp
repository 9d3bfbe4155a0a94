// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/json_text.h"

#include "dismantle/core/contract.h"

#include <charconv>
#include <cmath>
#include <iterator>

namespace dismantle {

namespace {

std::string number_text(double number) {
  DISMANTLE_EXPECT(std::isfinite(number));
  if (number == 0 && std::signbit(number)) return "-0.0";  // "-0" reads back as the integer 0
  char buffer[32];
  const auto [end, error] = std::to_chars(std::begin(buffer), std::end(buffer), number);
  DISMANTLE_ENSURE(error == std::errc{});
  return {buffer, end};
}

std::string scalar_text(const JsonValue& value) {
  if (value.is_number_float()) return number_text(value.get<double>());
  return value.dump(-1, ' ', false, JsonValue::error_handler_t::replace);
}

void append(std::string& text, const JsonValue& value) {
  if (!value.is_structured()) {
    text += scalar_text(value);
    return;
  }
  text += value.is_object() ? '{' : '[';
  const char* separator = "";
  for (const auto& [name, item] : value.items()) {
    text += separator;
    if (value.is_object()) text += scalar_text(name) + ": ";
    append(text, item);
    separator = ", ";
  }
  text += value.is_object() ? '}' : ']';
}

}  // namespace

std::string json_line(const JsonValue& value) {
  std::string text;
  append(text, value);
  return text;
}

std::string json_lines(const std::vector<std::string>& items, int indent) {
  std::string text;
  for (const std::string& item : items)
    text += (text.empty() ? "\n" : ",\n") + std::string(static_cast<std::size_t>(indent), ' ') + item;
  return text;
}

}  // namespace dismantle
