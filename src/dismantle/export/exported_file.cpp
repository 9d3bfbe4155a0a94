// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/exported_file.h"

#include "dismantle/documents/bill_of_materials.h"
#include "dismantle/documents/path_file.h"

#include <iterator>
#include <utility>

namespace dismantle {

namespace {

Result<std::string> animated_glb(const Assembly& assembly, const Timeline& timeline, const ExportOptions& options) {
  GlbOptions glb;
  glb.animations = path_animations(timeline, options.direction);
  if (options.direction == PathDirection::Reversed)
    glb.poses = timeline.poses_at(timeline.end(), assembly.components.size());
  glb.progress = options.progress;
  return glb_from_assembly(assembly, glb);
}

/// Endings of file names; one that ends with another one comes before it.
constexpr std::pair<std::string_view, ExportFormat> kEndings[] = {
    {".glb", ExportFormat::Glb},          {"instructions.html", ExportFormat::InstructionsHtml},
    {".html", ExportFormat::Html},        {".pdf", ExportFormat::InstructionsPdf},
    {".png", ExportFormat::Png},          {".stl", ExportFormat::SweptStl},
    {"bom.csv", ExportFormat::BillCsv},   {".csv", ExportFormat::Moves},
    {"bom.json", ExportFormat::BillJson}, {".path.json", ExportFormat::Path}};

}  // namespace

std::string export_endings() {
  std::string text;
  for (std::size_t i = 0; i < std::size(kEndings); ++i)
    text.append(i == 0 ? "" : i + 1 < std::size(kEndings) ? ", " : " or ").append(kEndings[i].first);
  return text;
}

std::optional<ExportFormat> export_format_of(std::string_view file) {
  for (const auto& [ending, format] : kEndings)
    if (file.size() >= ending.size() && file.substr(file.size() - ending.size()) == ending) return format;
  return {};
}

bool has_own_writer(ExportFormat format) {
  return format == ExportFormat::Png || format == ExportFormat::InstructionsHtml ||
         format == ExportFormat::InstructionsPdf || format == ExportFormat::SweptStl;
}

bool needs_path(ExportFormat format) {
  return format == ExportFormat::Moves || format == ExportFormat::Path || format == ExportFormat::InstructionsHtml ||
         format == ExportFormat::InstructionsPdf || format == ExportFormat::SweptStl;
}

bool depends_on_direction(ExportFormat format) {
  return format != ExportFormat::BillCsv && format != ExportFormat::BillJson && format != ExportFormat::SweptStl;
}

Result<std::string> exported_file(ExportFormat format, const Assembly& assembly, const Path& path,
                                  const ExportOptions& options) {
  DISMANTLE_EXPECT(!has_own_writer(format));
  const Result<Timeline> timeline = Timeline::of_path(assembly, path);
  if (!timeline) return timeline.error();
  switch (format) {
    case ExportFormat::Glb:
      return animated_glb(assembly, *timeline, options);
    case ExportFormat::Html:
      return offline_page(assembly, path, options.viewer, {options.direction, options.progress});
    case ExportFormat::Moves:
      return moves_csv(assembly, *timeline, {options.direction, options.clearances});
    case ExportFormat::BillCsv:
      return bill_csv(assembly, bill_of_materials(assembly));
    case ExportFormat::BillJson:
      return bill_json(assembly, bill_of_materials(assembly));
    case ExportFormat::Path:
    case ExportFormat::Png:
    case ExportFormat::InstructionsHtml:
    case ExportFormat::InstructionsPdf:
    case ExportFormat::SweptStl:
      break;
  }
  return path_text(options.direction == PathDirection::Forward ? path : there_and_back(path));
}

}  // namespace dismantle
