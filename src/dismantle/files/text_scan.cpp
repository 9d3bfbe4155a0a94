// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/text_scan.h"

#include <charconv>
#include <cmath>

namespace dismantle {

namespace {

/// from_chars does not accept a leading '+'.
std::string_view without_plus(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return plus ? word.substr(1) : word;
}

/// True if a number out of range for double is too small rather than too large.
bool is_underflow(std::string_view word) {
  const std::size_t exponent = word.find_first_of("eE");
  if (exponent != std::string_view::npos && exponent + 1 < word.size()) return word[exponent + 1] == '-';
  return word.substr(0, word.find('.')).find_first_of("123456789") == std::string_view::npos;
}

}  // namespace

std::string_view without_byte_order_mark(std::string_view text) {
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string_view take_word(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

std::optional<double> to_double(std::string_view word) {
  word = without_plus(word);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) return is_underflow(word) ? std::optional(0.0) : std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> to_integer(std::string_view word) {
  word = without_plus(word);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return end == word.data() + word.size() && error == std::errc{} ? std::optional(value) : std::nullopt;
}

std::optional<std::string_view> LineReader::next() {
  if (rest_.empty()) return std::nullopt;
  ++line_;
  const std::size_t end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::optional<std::string_view> LineReader::next_joined() {
  std::optional<std::string_view> line = next();
  if (!line || line->empty() || line->back() != '\\') return line;
  joined_.clear();
  while (line && !line->empty() && line->back() == '\\') {
    joined_.append(line->substr(0, line->size() - 1)).push_back(' ');
    line = next();
  }
  if (line) joined_.append(*line);
  return joined_;
}

std::string_view WordReader::next() {
  std::size_t begin = 0;
  while (begin < rest_.size() && (is_blank(rest_[begin]) || rest_[begin] == '\n')) line_ += rest_[begin++] == '\n';
  std::size_t end = begin;
  while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != '\n') ++end;
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

std::string_view WordReader::rest_of_line() {
  const std::string_view line = rest_.substr(0, rest_.find('\n'));
  rest_.remove_prefix(line.size());
  return trimmed(line);
}

}  // namespace dismantle
