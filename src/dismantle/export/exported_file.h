// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/export/moves_table.h"
#include "dismantle/export/offline_page.h"

#include <optional>
#include <string>
#include <string_view>

namespace dismantle {

/// Formats in which an assembly and its path are exported; docs/export.md.
enum class ExportFormat { Glb, Html, Png, Moves, BillCsv, BillJson, Path, InstructionsHtml, InstructionsPdf, SweptStl };

/// True for formats that exported_file() does not write: pictures (step_scene.h), swept volumes (swept_volume.h) and
/// work instructions (instructions/).
bool has_own_writer(ExportFormat format);

/// The format selected by the ending of a file name; nothing if the ending is unknown.
std::optional<ExportFormat> export_format_of(std::string_view file);
/// All endings that export_format_of() knows, for a sentence: ".glb, instructions.html, ... or .path.json".
std::string export_endings();

/// True if a format describes moves and therefore requires a path.
bool needs_path(ExportFormat format);
/// True if the content of a format depends on the direction of the path.
bool depends_on_direction(ExportFormat format);

/// Options of exported_file().
struct ExportOptions {
  PathDirection direction = PathDirection::Forward;  ///< Order in which moves are exported.
  std::vector<MoveClearance> clearances;             ///< For Moves: see MovesTableOptions::clearances.
  ViewerFiles viewer;                                ///< For Html.
  ProgressCallback progress;                         ///< Reports and cancels.
};

/// The content of a file in the given format. Errors: Unreadable if the path does not match the assembly, Failed if the
/// file would be too large or the export was cancelled.
/// @pre !has_own_writer(format)
Result<std::string> exported_file(ExportFormat format, const Assembly& assembly, const Path& path,
                                  const ExportOptions& options = {});

}  // namespace dismantle
