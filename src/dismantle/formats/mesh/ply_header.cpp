// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/ply_header.h"

#include "dismantle/files/text_scan.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

std::optional<PlyType> ply_type(std::string_view name) {
  constexpr std::pair<std::string_view, PlyType> kTypes[] = {
      {"char", PlyType::Int8},      {"int8", PlyType::Int8},       {"uchar", PlyType::Uint8},
      {"uint8", PlyType::Uint8},    {"short", PlyType::Int16},     {"int16", PlyType::Int16},
      {"ushort", PlyType::Uint16},  {"uint16", PlyType::Uint16},   {"int", PlyType::Int32},
      {"int32", PlyType::Int32},    {"uint", PlyType::Uint32},     {"uint32", PlyType::Uint32},
      {"float", PlyType::Float32},  {"float32", PlyType::Float32}, {"double", PlyType::Float64},
      {"float64", PlyType::Float64}};
  for (const auto& [known, type] : kTypes)
    if (known == name) return type;
  return std::nullopt;
}

std::optional<PlyFormat> ply_format(std::string_view name) {
  if (name == "ascii") return PlyFormat::Ascii;
  if (name == "binary_little_endian") return PlyFormat::BinaryLittleEndian;
  if (name == "binary_big_endian") return PlyFormat::BinaryBigEndian;
  return std::nullopt;
}

/// Reads the header line by line.
class HeaderParser {
 public:
  explicit HeaderParser(const MeshSource& source) : source_(source), lines_(source.bytes) {}
  Result<PlyHeader> parse();

 private:
  std::optional<Error> statement(std::string_view keyword, std::string_view rest);
  std::optional<Error> format(std::string_view rest);
  std::optional<Error> element(std::string_view rest);
  std::optional<Error> property(std::string_view rest);
  std::optional<Error> check_counts();
  Error here(const std::string& why) const {
    return malformed(source_, "PLY", "line " + std::to_string(lines_.line()) + ": " + why);
  }

  const MeshSource& source_;
  LineReader lines_;
  PlyHeader header_;
  bool has_format_ = false;
};

Result<PlyHeader> HeaderParser::parse() {
  const std::optional<std::string_view> magic = lines_.next();
  if (!magic || trimmed(*magic) != "ply") return malformed(source_, "PLY", "it does not begin with \"ply\"");
  while (std::optional<std::string_view> line = lines_.next()) {
    const std::string_view keyword = take_word(*line);
    if (keyword == "end_header") {
      if (!has_format_) return here("the header names no format");
      header_.body_offset = source_.bytes.size() - lines_.rest().size();
      if (auto error = check_counts()) return *error;
      return std::move(header_);
    }
    if (auto error = statement(keyword, *line)) return *error;
  }
  return malformed(source_, "PLY", "its header does not end");
}

std::optional<Error> HeaderParser::statement(std::string_view keyword, std::string_view rest) {
  if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return std::nullopt;
  if (keyword == "format") return format(rest);
  if (keyword == "element") return element(rest);
  if (keyword == "property") return property(rest);
  return here("unknown statement " + in_quotes(keyword));
}

std::optional<Error> HeaderParser::format(std::string_view rest) {
  const std::string_view name = take_word(rest);
  const std::optional<PlyFormat> known = ply_format(name);
  if (!known) return here("unknown format " + in_quotes(name));
  header_.format = *known;
  has_format_ = true;
  return std::nullopt;
}

std::optional<Error> HeaderParser::element(std::string_view rest) {
  PlyElement element;
  element.name = take_word(rest);
  const std::string_view word = take_word(rest);
  const std::optional<std::int64_t> count = to_integer(word);
  if (!count || *count < 0) return here(in_quotes(word) + " is no number of elements");
  element.count = static_cast<std::uint64_t>(*count);
  header_.elements.push_back(std::move(element));
  return std::nullopt;
}

std::optional<Error> HeaderParser::property(std::string_view rest) {
  if (header_.elements.empty()) return here("a property before the first element");
  PlyProperty property;
  std::string_view word = take_word(rest);
  if (word == "list") {
    word = take_word(rest);
    property.length_type = ply_type(word);
    if (!property.length_type || !is_integer(*property.length_type))
      return here(in_quotes(word) + " is no type of a list's length");
    word = take_word(rest);
  }
  const std::optional<PlyType> type = ply_type(word);
  if (!type) return here("unknown type " + in_quotes(word));
  property.type = *type;
  property.name = take_word(rest);
  header_.elements.back().properties.push_back(std::move(property));
  return std::nullopt;
}

/// Refuses an element with more rows than the body can hold, before anything is allocated for it.
std::optional<Error> HeaderParser::check_counts() {
  const std::size_t body = source_.bytes.size() - header_.body_offset;
  for (const PlyElement& e : header_.elements) {
    std::size_t row = 0;  // the fewest bytes of a row: in text, a digit and a blank for each number
    for (const PlyProperty& p : e.properties)
      row += header_.format == PlyFormat::Ascii ? 2 : byte_count(p.length_type.value_or(p.type));
    if (row > 0 && e.count > (body + 1) / row)
      return malformed(source_, "PLY",
                       "it claims " + std::to_string(e.count) + " rows of " + in_quotes(e.name) + " in " +
                           std::to_string(body) + " bytes");
  }
  return std::nullopt;
}

}  // namespace

std::size_t byte_count(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::Uint8:
      return 1;
    case PlyType::Int16:
    case PlyType::Uint16:
      return 2;
    case PlyType::Int32:
    case PlyType::Uint32:
    case PlyType::Float32:
      return 4;
    case PlyType::Float64:
      return 8;
  }
  return 0;
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  const auto place =
      std::find_if(properties.begin(), properties.end(), [&](const PlyProperty& p) { return p.name == property; });
  if (place == properties.end()) return std::nullopt;
  return static_cast<std::size_t>(place - properties.begin());
}

Result<PlyHeader> parse_ply_header(const MeshSource& source) {
  return HeaderParser(source).parse();
}

}  // namespace dismantle
