// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace dismantle {

/// Splits the text of a VRML file into words: brackets and braces by themselves, strings with their quotes, and runs of
/// all other characters. Blanks, commas and comments are between words. Counts lines.
class VrmlWords {
 public:
  /// `text` must outlive it.
  explicit VrmlWords(std::string_view text) : rest_(text) {}

  /// The next word; empty at the end of the text.
  std::string_view next();
  /// The word that next() would return.
  std::string_view peek() const { return VrmlWords(*this).next(); }
  /// The number of the line that holds the last word, from 1.
  std::size_t line() const { return line_; }

  /// Takes the next word if it is a number. None, without taking it, if it is not, or is not finite.
  std::optional<double> number();
  /// Takes all words up to the `end` that matches a `begin` taken before. @return false if there is none
  bool skip_past(std::string_view begin, std::string_view end);

 private:
  void skip_blanks();

  std::string_view rest_;
  std::size_t line_ = 1;
};

}  // namespace dismantle
