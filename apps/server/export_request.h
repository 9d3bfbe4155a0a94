// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model.h"
#include "apps/server/site.h"
#include "apps/server/url.h"
#include "dismantle/export/exported_file.h"

#include <optional>
#include <string>

namespace dismantle::server {

/// A file that a client asks for under /api/export/ (docs/wire.md).
struct ExportRequest {
  ExportFormat format = ExportFormat::Glb;
  std::string content_type;
  PathDirection direction = PathDirection::Forward;
  bool of_guide = false;  ///< Not the recording, but the path that is followed.
};

/// The data to export, captured while nothing moves.
struct ExportSource {
  std::shared_ptr<const Assembly> assembly;
  Path path;
};

/// None where there is no such file.
std::optional<ExportRequest> parse_export(const RequestTarget& target);

/// Errors: Usage where nothing is open, or there is no path; Unreadable as of parse_path.
Result<ExportSource> export_source(const ExportRequest& request, const Model* model);

/// Makes the file; may take seconds.
HttpAnswer export_answer(const ExportRequest& request, const ExportSource& source);

}  // namespace dismantle::server
