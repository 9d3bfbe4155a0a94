// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/export/path_animations.h"

#include <string>
#include <string_view>

namespace dismantle {

/// The viewer's files (web/) that an offline page embeds.
struct ViewerFiles {
  std::string_view script;   ///< A module without imports.
  std::string_view style;    ///< Style sheet of the viewer.
  std::string_view offline;  ///< Additional style sheet of offline pages.
  std::string_view icon;     ///< SVG.
};

/// Options of offline_page().
struct OfflinePageOptions {
  PathDirection direction = PathDirection::Forward;  ///< Direction in which the path is played.
  ProgressCallback progress;                         ///< Reports and cancels.
};

/// A self-contained HTML page that shows an assembly and plays its path. It embeds the viewer, the model and the path,
/// needs no server, and its content security policy forbids loading anything. Deterministic.
/// @pre the path matches the assembly (Timeline::of_path)
/// Errors: Failed if the model is too large or the export was cancelled.
Result<std::string> offline_page(const Assembly& assembly, const Path& path, const ViewerFiles& files,
                                 const OfflinePageOptions& options = {});

}  // namespace dismantle
