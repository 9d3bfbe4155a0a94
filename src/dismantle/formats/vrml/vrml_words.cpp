// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/vrml/vrml_words.h"

#include "dismantle/files/text_scan.h"

#include <algorithm>

namespace dismantle {

namespace {

bool parts_words(char c) {
  return static_cast<unsigned char>(c) <= ' ' || c == ',' || c == '#' || c == '"' || c == '[' || c == ']' || c == '{' ||
         c == '}';
}

}  // namespace

void VrmlWords::skip_blanks() {
  while (!rest_.empty()) {
    const char c = rest_[0];
    if (c == '#') {
      rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
    } else if (static_cast<unsigned char>(c) <= ' ' || c == ',') {
      if (c == '\n') ++line_;
      rest_.remove_prefix(1);
    } else {
      break;
    }
  }
}

std::string_view VrmlWords::next() {
  skip_blanks();
  if (rest_.empty()) return {};
  std::size_t size = 1;
  if (rest_[0] == '"') {
    while (size < rest_.size() && rest_[size] != '"') size += rest_[size] == '\\' ? 2 : 1;
    size = std::min(size + 1, rest_.size());
  } else if (!parts_words(rest_[0])) {
    while (size < rest_.size() && !parts_words(rest_[size])) ++size;
  }
  const std::string_view word = rest_.substr(0, size);
  if (word[0] == '"') line_ += static_cast<std::size_t>(std::count(word.begin(), word.end(), '\n'));
  rest_.remove_prefix(size);
  return word;
}

std::optional<double> VrmlWords::number() {
  const VrmlWords before = *this;
  const std::optional<double> value = to_double(next());
  if (!value) *this = before;
  return value;
}

bool VrmlWords::skip_past(std::string_view begin, std::string_view end) {
  for (std::size_t depth = 1; depth > 0;) {
    const std::string_view word = next();
    if (word.empty()) return false;
    if (word == begin) ++depth;
    if (word == end) --depth;
  }
  return true;
}

}  // namespace dismantle
