// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/export/moves_table.h"
#include "dismantle/export/offline_page.h"

#include <optional>
#include <string>
#include <string_view>

namespace dismantle {

/// What an assembly and its path are written as; docs/export.md.
enum class ExportFormat { Glb, Html, Png, Moves, BillCsv, BillJson, Path, InstructionsHtml, InstructionsPdf, SweptStl };

/// Whether a format is made elsewhere: pictures (step_scene.h), swept volumes (swept_volume.h) and work instructions
/// (instructions/).
bool is_made_elsewhere(ExportFormat format);

/// The format that a file's name tells by how it ends; nothing where it tells none.
std::optional<ExportFormat> export_format_of(std::string_view file);

/// Whether a format is about moves only, so that there has to be a path.
bool needs_path(ExportFormat format);
/// Whether a format tells moves apart from their reverse.
bool knows_direction(ExportFormat format);

struct ExportOptions {
  PathDirection direction = PathDirection::Forward;
  std::vector<MoveClearance> clearances;  ///< For Moves: as MovesTableOptions has them.
  ViewerFiles viewer;                     ///< For Html.
  ProgressCallback progress;
};

/// The file's bytes. Errors: Unreadable where the path does not fit the
/// assembly, Failed where the file would be too large or was cancelled.
/// @pre !is_made_elsewhere(format)
Result<std::string> exported_file(ExportFormat format, const Assembly& assembly, const Path& path,
                                  const ExportOptions& options = {});

}  // namespace dismantle
