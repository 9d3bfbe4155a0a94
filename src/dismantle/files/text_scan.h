// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dismantle {

/// True for the blanks within a line.
constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The text with ASCII letters in lower case.
std::string lower_case(std::string_view text);

/// Removes the first word from `rest` and returns it; empty at the end.
std::string_view take_word(std::string_view& rest);

/// The whole of `word` as a number, whatever the locale; a leading '+' is allowed. A number too small for a double
/// becomes 0; none if it is not a number, is infinite or NaN, or is too large for a double.
std::optional<double> to_double(std::string_view word);

/// The whole of `word` as an integer; a leading '+' is allowed. None if it is not an integer or out of range.
std::optional<std::int64_t> to_integer(std::string_view word);

/// The text without the byte order mark that some editors put before UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

/// Splits a text into lines and counts them. Lines end with LF or CR LF; a byte order mark is skipped.
class LineReader {
 public:
  /// `text` must outlive the reader.
  explicit LineReader(std::string_view text) : rest_(without_byte_order_mark(text)) {}

  /// The next line without its line end; none at the end of the text.
  std::optional<std::string_view> next();

  /// As next(), but a line that ends with a backslash is joined with the following one. Valid until the next call.
  std::optional<std::string_view> next_joined();

  /// The number of the line returned last, from 1; of joined lines, the last one's.
  std::size_t line() const { return line_; }
  /// The text after that line.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string joined_;
  std::size_t line_ = 0;
};

/// Splits a text into words, across lines, and counts the lines; a byte order mark is skipped.
class WordReader {
 public:
  /// `text` must outlive the reader.
  explicit WordReader(std::string_view text) : rest_(without_byte_order_mark(text)) {}

  /// The next word; empty at the end of the text.
  std::string_view next();

  /// The rest of the current line, without its line end.
  std::string_view rest_of_line();

  /// The number of the line that holds the last word, from 1.
  std::size_t line() const { return line_; }
  /// The text after the last word.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t line_ = 1;
};

}  // namespace dismantle
