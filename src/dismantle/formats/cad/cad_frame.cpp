// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/cad_frame.h"

#include <algorithm>
#include <string>

namespace dismantle {

namespace {

constexpr std::size_t kSearched = 4096;  // bytes at either end of the file
constexpr std::string_view kZip = "PK\x03\x04";

Error unreadable(const std::string& problem) {
  return {ErrorKind::Unreadable, problem};
}

Result<Done> check_step(std::string_view head, std::string_view tail) {
  if (head.find("ISO-10303-21") == std::string_view::npos)
    return unreadable("it does not begin with ISO-10303-21; check that it is a STEP file");
  if (tail.find("END-ISO-10303-21") == std::string_view::npos)
    return unreadable("it ends too early: END-ISO-10303-21 is missing; get the whole file or export it again");
  return Done{};
}

/// The letter of the section that a line of an IGES file belongs to: column 73.
char iges_section(std::string_view line) {
  constexpr std::size_t kColumn = 72;
  return line.size() > kColumn ? line[kColumn] : '\0';
}

Result<Done> check_iges(std::string_view head, std::string_view tail) {
  const char first = iges_section(head.substr(0, head.find_first_of("\r\n")));
  if (first == 'C') return unreadable("it is in IGES's compressed form; export it as plain text");
  if (first == 'B') return unreadable("it is in IGES's binary form; export it as text");
  if (first != 'S' && first != 'G')
    return unreadable("it does not begin with a start section; check that it is an IGES file");
  while (!tail.empty()) {
    const std::size_t end = tail.find_last_not_of(" \r\n\t\x1a");
    if (end == std::string_view::npos) break;
    tail = tail.substr(0, end + 1);
    const std::size_t begin = tail.find_last_of("\r\n");
    if (iges_section(begin == std::string_view::npos ? tail : tail.substr(begin + 1)) == 'T') return Done{};
    break;
  }
  return unreadable("it ends too early: its terminate section is missing; get the whole file or export it again");
}

Result<Done> check_brep(std::string_view head) {
  for (const std::string_view mark : {"CASCADE Topology V", "Open CASCADE Topology V"})
    if (head.substr(0, kSearched / 4).find(mark) != std::string_view::npos) return Done{};
  return unreadable("it does not begin with CASCADE Topology; check that it is a BREP file");
}

}  // namespace

Result<Done> check_cad_frame(FileFormat format, std::string_view bytes) {
  const std::string_view head = bytes.substr(0, kSearched);
  const std::string_view tail = bytes.substr(bytes.size() - std::min(bytes.size(), kSearched));
  if (head.substr(0, 2) == "\x1f\x8b") return unreadable("it is compressed with gzip; unpack it first");
  if (head.substr(0, kZip.size()) == kZip && format != FileFormat::FreeCad)
    return unreadable("it is a zip archive; unpack it first");
  switch (format) {
    case FileFormat::Step:
      return check_step(head, tail);
    case FileFormat::Iges:
      return check_iges(head, tail);
    case FileFormat::Brep:
      return check_brep(head);
    default:
      return Done{};
  }
}

}  // namespace dismantle
