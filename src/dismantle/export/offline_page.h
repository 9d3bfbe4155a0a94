// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/export/path_animations.h"

#include <string>
#include <string_view>

namespace dismantle {

/// The files of the viewer's page (web/) that an offline page is made of.
struct ViewerFiles {
  std::string_view script;   ///< One script, a module without imports.
  std::string_view style;    ///< Of the viewer.
  std::string_view offline;  ///< What is different in an offline page.
  std::string_view icon;     ///< SVG.
};

struct OfflinePageOptions {
  PathDirection direction = PathDirection::Forward;
  ProgressCallback progress;
};

/// One HTML page that shows an assembly and plays its path: it holds the viewer, the model and the path in itself,
/// needs no server, loads nothing from anywhere, and its own policy forbids it to. Same input, same bytes.
/// @pre the path fits the assembly (Timeline::of_path)
/// Errors: Failed where the model is too large, or where it was cancelled.
Result<std::string> offline_page(const Assembly& assembly, const Path& path, const ViewerFiles& files,
                                 const OfflinePageOptions& options = {});

}  // namespace dismantle
