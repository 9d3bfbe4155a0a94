// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instruction_names.h"

#include <algorithm>
#include <map>
#include <string_view>

namespace dismantle {

namespace {

/// Longer names are not repeated in running text, and shortened in titles [characters].
constexpr std::size_t kMaxLength = 32;
/// Of a shortened name, as many characters of its end are shown.
constexpr std::size_t kEndLength = 12;
/// Maximum number of names in a list; the rest is counted.
constexpr std::size_t kMaxNames = 6;
constexpr const char* kEllipsis = "\u2026";

bool begins_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

std::size_t character_count(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

bool is_long(const std::string& name) {
  return character_count(name) > kMaxLength;
}

/// The byte at which a character begins. @pre index < character_count(text)
std::size_t begin_of_character(const std::string& text, std::size_t index) {
  std::size_t at = 0;
  for (std::size_t passed = 0; passed < index || !begins_character(text[at]); ++at)
    passed += begins_character(text[at]);
  return at;
}

/// The first and the last characters of a long name, which often tell the variant, and an ellipsis in between; a
/// shorter name as it is.
std::string shortened(const std::string& name) {
  if (!is_long(name)) return name;
  const std::size_t first = kMaxLength - kEndLength;
  return name.substr(0, begin_of_character(name, first)) + kEllipsis +
         name.substr(begin_of_character(name, character_count(name) - kEndLength));
}

std::string number_of(std::size_t item) {
  return "item " + std::to_string(item + 1);
}

std::string titled(const std::string& name, std::size_t item) {
  return is_long(name) ? shortened(name) + " (" + number_of(item) + ")" : name;
}

}  // namespace

InstructionNames::InstructionNames(const Assembly& assembly, const std::vector<BillItem>& bill,
                                   const MissingGlyphs& missing_glyphs)
    : assembly_(assembly), bill_(bill), items_(assembly.components.size()), missing_glyphs_(missing_glyphs) {
  std::map<std::string_view, std::size_t> counts;
  for (const BillItem& item : bill) ++counts[item.name];
  for (const BillItem& item : bill) is_ambiguous_.push_back(counts[item.name] > 1);
  for (std::size_t item = 0; item < bill.size(); ++item) {
    for (const ComponentId c : bill[item].components) items_[c.value] = item;
    if (missing_glyphs_) missing_ += missing_glyphs_(bill[item].name);
  }
  // Each character once, in order.
  std::string once;
  for (std::size_t begin = 0, end = 0; begin < missing_.size(); begin = end) {
    for (end = begin + 1; end < missing_.size() && !begins_character(missing_[end]);) ++end;
    const std::string character = missing_.substr(begin, end - begin);
    if (once.find(character) == std::string::npos) once += character;
  }
  missing_ = once;
}

bool InstructionNames::can_show(const std::string& name) const {
  return !missing_glyphs_ || missing_glyphs_(name).empty();
}

std::string InstructionNames::in_text(const std::string& name, std::size_t item) const {
  if (is_long(name) || !can_show(name)) return number_of(item);
  return is_ambiguous_[item] ? name + " (" + number_of(item) + ")" : name;
}

std::string InstructionNames::of(ComponentId c) const {
  return in_text(assembly_[c].name, items_[c.value]);
}

std::string InstructionNames::in_title(ComponentId c) const {
  const std::string& name = assembly_[c].name;
  return can_show(name) ? titled(name, items_[c.value]) : number_of(items_[c.value]);
}

std::string InstructionNames::of_item(std::size_t item) const {
  return in_text(bill_[item].name, item);
}

std::string InstructionNames::item_in_title(std::size_t item) const {
  return can_show(bill_[item].name) ? titled(bill_[item].name, item) : number_of(item);
}

std::string InstructionNames::in_list(std::size_t item) const {
  return can_show(bill_[item].name) ? bill_[item].name : number_of(item);
}

std::string InstructionNames::of_body(const std::string& name) const {
  return can_show(name) ? shortened(name) : std::string();
}

std::string list_text(const std::vector<std::string>& names) {
  const std::size_t named = names.size() <= kMaxNames ? names.size() : kMaxNames - 1;
  std::string text;
  for (std::size_t i = 0; i < named; ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  if (named < names.size()) text += " and " + std::to_string(names.size() - named) + " more";
  return text;
}

}  // namespace dismantle
