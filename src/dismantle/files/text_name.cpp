// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/text_name.h"

#include <cstddef>
#include <cstdint>

namespace dismantle {

namespace {

constexpr std::size_t kLongestStem = 200;

bool continues(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

/// The number of bytes of the UTF-8 character at the start of `text`; 0 if there is none (RFC 3629: no
/// overlong forms, no surrogates, nothing above U+10FFFF).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xc2 && first <= 0xdf   ? 2
                             : first >= 0xe0 && first <= 0xef ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!continues(text[i])) return 0;
  const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool beyond = (first == 0xed && byte(1) > 0x9f) || (first == 0xf4 && byte(1) > 0x8f);
  return overlong || beyond ? 0 : length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string utf8_from_latin1(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      result.push_back(c);
    } else {
      result.push_back(static_cast<char>(0xc0 | code >> 6));
      result.push_back(static_cast<char>(0x80 | (code & 0x3f)));
    }
  }
  return result;
}

}  // namespace

std::string clean_name(std::string_view name) {
  const std::string text = is_utf8(name) ? std::string(name) : utf8_from_latin1(name);
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    const bool is_c1 = code == 0xc2 && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (is_c1) ++i;
    result.push_back(code < 0x20 || code == 0x7f || is_c1 ? '_' : text[i]);
  }
  return result;
}

std::string file_stem(std::string_view name) {
  std::string stem = clean_name(name);
  for (char& c : stem)
    if (c == '/') c = '_';
  std::size_t length = stem.size() < kLongestStem ? stem.size() : kLongestStem;
  while (length < stem.size() && length > 0 && continues(stem[length])) --length;
  stem.resize(length);
  if (stem.empty() || stem[0] == '.') stem.insert(stem.begin(), '_');
  return stem;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  for (const char c : text.substr(0, kLongest)) result.push_back(c >= ' ' && c <= '~' ? c : '?');
  return result + (text.size() > kLongest ? "...\"" : "\"");
}

}  // namespace dismantle
