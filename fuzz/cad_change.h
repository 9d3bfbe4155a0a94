// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuzz/structured_change.h"

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

/// Changes of CAD files that keep most of their grammar, so that they come past the lexers of OpenCASCADE.
namespace dismantle::fuzz {

/// The text formats that CAD kernels exchange.
enum class CadText { Step, Iges, Brep };

/// As it looks; STEP where it looks like nothing.
inline CadText cad_text_of(std::string_view text) {
  constexpr std::size_t kIgesSection = 72;  // the column of an IGES line that names its section
  if (text.starts_with("DBRep_") || text.starts_with("CASCADE") || text.starts_with("Open CASCADE"))
    return CadText::Brep;
  const bool is_iges = text.size() > kIgesSection && text[kIgesSection] == 'S' && !text.starts_with("ISO-10303");
  return is_iges ? CadText::Iges : CadText::Step;
}

/// The statements of a STEP file, each with its ';', or the lines of another.
inline std::vector<TextRange> statements_of(std::string_view text, CadText kind) {
  std::vector<TextRange> result;
  std::size_t begin = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (kind == CadText::Step && text[i] == '\'') in_string = !in_string;
    if (in_string || text[i] != (kind == CadText::Step ? ';' : '\n')) continue;
    result.push_back({begin, i + 1});
    begin = i + 1;
  }
  if (begin < text.size()) result.push_back({begin, text.size()});
  return result;
}

/// The numbers of a text; of a STEP file with its references, whose '#' is not part of them.
inline std::vector<TextRange> numbers_in(std::string_view text) {
  std::vector<TextRange> result;
  const auto is_of_number = [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("+-.eED").find(c) != std::string_view::npos;
  };
  for (std::size_t i = 0; i < text.size();) {
    const bool starts =
        std::isdigit(static_cast<unsigned char>(text[i])) != 0 ||
        (text[i] == '-' && i + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0);
    if (!starts || (i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0 || text[i - 1] == '_'))) {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    while (end < text.size() && is_of_number(text[end])) ++end;
    result.push_back({i, end});
    i = end;
  }
  return result;
}

/// Strings between apostrophes, without them.
inline std::vector<TextRange> strings_in(std::string_view text) {
  std::vector<TextRange> result;
  for (std::size_t begin = text.find('\''); begin != std::string_view::npos;) {
    const std::size_t end = text.find('\'', begin + 1);
    if (end == std::string_view::npos) break;
    result.push_back({begin + 1, end});
    begin = text.find('\'', end + 1);
  }
  return result;
}

/// Words of capitals: the types of entities, and .ENUMERATORS.
inline std::vector<TextRange> keywords_in(std::string_view text) {
  std::vector<TextRange> result;
  const auto is_of_word = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_of_word(text[i])) continue;
    const std::size_t begin = i;
    while (i < text.size() && (is_of_word(text[i]) || std::isdigit(static_cast<unsigned char>(text[i])) != 0)) ++i;
    if (i - begin > 1) result.push_back({begin, i});
  }
  return result;
}

/// The parameters between commas and brackets.
inline std::vector<TextRange> parameters_in(std::string_view text) {
  std::vector<TextRange> result;
  for (std::size_t begin = text.find_first_of("(,"); begin != std::string_view::npos;) {
    const std::size_t end = text.find_first_of("(,)", begin + 1);
    if (end == std::string_view::npos) break;
    if (text[end] != '(' && end > begin + 1) result.push_back({begin + 1, end});
    begin = text[end] == ')' ? text.find_first_of("(,", end) : end;
  }
  return result;
}

/// Changes files of one kind.
class CadChange {
 public:
  CadChange(std::string& text, Choices& choices) : text_(text), choices_(choices), kind_(cad_text_of(text)) {}

  /// Makes one change.
  void make() {
    switch (choices_.below(kind_ == CadText::Step ? 12 : 7)) {
      case 0:
      case 1:
        return change_number();
      case 2:
        return drop_statements();
      case 3:
        return repeat_statement();
      case 4:
        return swap_statements();
      case 5:
        return cut();
      case 6:
        return change_bytes(text_, text_.size() + 64);
      case 7:
      case 8:
        return exchange(numbers_after_hash());
      case 9:
        return change_string();
      case 10:
        return exchange(keywords_in(text_));
      default:
        return change_parameter();
    }
  }

 private:
  void replace(TextRange range, std::string_view by) { text_.replace(range.begin, range.size(), by); }
  std::string at(TextRange range) const { return text_.substr(range.begin, range.size()); }

  void change_number() {
    static constexpr std::string_view kNumbers[] = {
        "0",          "0.",          "-0.",        "1",       "-1",    "-1.",   "2",   "3.",
        "1.E-7",      "1.E-300",     "1.E300",     "1E999",   "-1.E9", "1.E18", "90.", "2147483647",
        "2147483648", "-2147483648", "4294967296", "1000000", "65536", "0.5"};
    const std::vector<TextRange> numbers = numbers_in(text_);
    if (numbers.empty()) return;
    const TextRange range = choices_.of(numbers);
    std::string by(choices_.of(kNumbers));
    if (choices_.below(3) == 0) by = at(choices_.of(numbers));
    // The columns of an IGES file have a meaning.
    if (kind_ == CadText::Iges) by.resize(range.size(), '0');
    replace(range, by);
  }

  std::vector<TextRange> numbers_after_hash() const {
    std::vector<TextRange> result = numbers_in(text_);
    std::erase_if(result, [this](TextRange range) { return range.begin == 0 || text_[range.begin - 1] != '#'; });
    return result;
  }

  /// Puts one of the ranges in the place of another.
  void exchange(const std::vector<TextRange>& ranges) {
    if (!ranges.empty()) replace(choices_.of(ranges), at(choices_.of(ranges)));
  }

  void drop_statements() {
    const std::vector<TextRange> all = statements_of(text_, kind_);
    if (all.empty()) return;
    const std::size_t first = choices_.below(all.size()), last = std::min(first + choices_.below(3), all.size() - 1);
    replace({all[first].begin, all[last].end}, "");
  }

  void repeat_statement() {
    const std::vector<TextRange> all = statements_of(text_, kind_);
    if (!all.empty()) text_.insert(choices_.of(all).end, at(choices_.of(all)));
  }

  /// Of two entities, each gets what the other is.
  void swap_statements() {
    const std::vector<TextRange> all = statements_of(text_, kind_);
    if (all.size() < 2) return;
    const std::size_t i = choices_.below(all.size() - 1), k = i + 1 + choices_.below(all.size() - 1 - i);
    const auto body = [this](TextRange range) {
      const std::size_t equals = text_.find('=', range.begin);
      return equals < range.end ? TextRange{equals, range.end} : range;
    };
    const TextRange early = body(all[i]), late = body(all[k]);
    const std::string first = at(early), second = at(late);
    replace(late, first);
    replace(early, second);
  }

  /// A cut file, mostly with an end that hides it.
  void cut() {
    text_.resize(choices_.below(text_.size()));
    if (kind_ != CadText::Step || choices_.below(4) == 0) return;
    if (choices_.below(2) == 0) text_.resize(text_.rfind(';') + 1);
    text_ += "\nENDSEC;\nEND-ISO-10303-21;\n";
  }

  void change_string() {
    static const std::string kStrings[] = {"",
                                           "\\X2\\D83D\\X0\\",
                                           "\\X2\\00410042\\X0\\",
                                           "\\X\\C4",
                                           "\\S\\",
                                           "\\X4\\0010FFFF\\X0\\",
                                           "\\X2\\",
                                           "''",
                                           "a\nb\x01\x1b[31m",
                                           "\xff\xfe\xc0\x80",
                                           "\xed\xa0\x80",
                                           std::string(3000, 'a'),
                                           "../../etc/passwd",
                                           std::string("a\0b", 3),
                                           "'",
                                           "a;b#1=C(*"};
    const std::vector<TextRange> strings = strings_in(text_);
    if (!strings.empty()) replace(choices_.of(strings), choices_.of(kStrings));
  }

  void change_parameter() {
    static constexpr std::string_view kParameters[] = {"$",  "*",   "()",  "(())", "''",
                                                       "#1", ".T.", ".U.", "$,$",  "1.,2.,3."};
    const std::vector<TextRange> parameters = parameters_in(text_);
    if (parameters.empty()) return;
    const TextRange range = choices_.of(parameters);
    replace(range, choices_.below(3) == 0 ? at(choices_.of(parameters)) : std::string(choices_.of(kParameters)));
  }

  std::string& text_;
  Choices& choices_;
  CadText kind_;
};

}  // namespace dismantle::fuzz
