// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dismantle {

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// ASCII letters in lower case.
std::string lower_case(std::string_view text);

/// Takes the next word of a line off its front; empty at the end.
std::string_view take_word(std::string_view& rest);

/// The whole of `word` as a number, whatever the locale; a leading '+' is allowed. Too small becomes 0; nothing where
/// it is no number, infinite, NaN, or too large for a double.
std::optional<double> to_double(std::string_view word);

/// The whole of `word` as an integer; a leading '+' is allowed.
std::optional<std::int64_t> to_integer(std::string_view word);

/// The text without the byte order mark that some editors put before UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

/// Gives a text line by line and counts them. Lines end with LF or CR LF; a byte order mark is passed over.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(without_byte_order_mark(text)) {}

  /// The next line without its end; nothing at the end of the text.
  std::optional<std::string_view> next();

  /// As next(), but a line whose last character is a backslash goes on with the following one; valid until the next
  /// call.
  std::optional<std::string_view> next_joined();

  /// The number of the line given last, from 1 on; of joined lines, the last one's.
  std::size_t line() const { return line_; }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string joined_;
  std::size_t line_ = 0;
};

/// Gives a text word by word, across lines, and counts the lines; a byte order mark is passed over.
class WordReader {
 public:
  explicit WordReader(std::string_view text) : rest_(without_byte_order_mark(text)) {}

  /// The next word; empty at the end of the text.
  std::string_view next();

  /// What is left of the current line, without its end.
  std::string_view rest_of_line();

  /// The number of the line that the last word stands in.
  std::size_t line() const { return line_; }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t line_ = 1;
};

}  // namespace dismantle
