// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/number_text.h"
#include "dismantle/instructions/motion_text.h"
#include "dismantle/instructions/work_instructions.h"

namespace dismantle {

namespace {

using Kind = InstructionNote::Kind;

constexpr const char* kTimes = " \u00d7 ";

}  // namespace

std::string counted_name(const WorkInstructions& instructions, const CountedPart& part) {
  const PartsLine& line = instructions.parts[part.item];
  const std::string& name = line.label.empty() ? line.name : line.label;
  return part.count > 1 ? std::to_string(part.count) + kTimes + name : name;
}

const char* heading_of(InstructionNote::Kind kind) {
  switch (kind) {
    case Kind::Motion:
      return "Motion";
    case Kind::Tool:
      return "Tools";
    case Kind::Warning:
      return "Caution";
    case Kind::Clearance:
      return "Clearance";
    case Kind::Overlap:
      return "Interference in the CAD models";
  }
  return "";
}

std::string part_text(const WorkInstructions& instructions, const CountedPart& part) {
  const std::string item = "item " + std::to_string(part.item + 1);
  const PartsLine& line = instructions.parts[part.item];
  const std::string text = counted_name(instructions, part);
  const bool has_number = line.label == item || line.label.ends_with("(" + item + ")");
  return has_number ? text : text + " (" + item + ")";
}

std::string part_name_text(const PartsLine& line) {
  return line.fastener.empty() ? line.name : line.name + ", " + line.fastener;
}

std::string size_text(const Vec3& size) {
  return number_text(size.x) + kTimes + number_text(size.y) + kTimes + number_text(size.z);
}

std::vector<std::pair<std::string, std::string>> title_block_entries(const TitleBlock& block) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const auto& [heading, text] : {std::pair("Number", &block.number), std::pair("Revision", &block.revision),
                                      std::pair("Author", &block.author), std::pair("Date", &block.date)})
    if (!text->empty()) entries.emplace_back(heading, *text);
  return entries;
}

std::string summary_text(const WorkInstructions& instructions) {
  std::size_t components = 0;
  for (const PartsLine& line : instructions.parts) components += line.count;
  return count_text(instructions.steps.size(), "step") + ", " + count_text(components, "component") + " of " +
         count_text(instructions.parts.size(), "kind") + "; " +
         count_text(instructions.stationary.size(), "base part") + ". Source: " + instructions.assembly + ".";
}

}  // namespace dismantle
