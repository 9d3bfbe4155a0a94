// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model.h"
#include "apps/server/site.h"
#include "apps/server/url.h"
#include "dismantle/export/exported_file.h"

#include <optional>
#include <string>

namespace dismantle::server {

/// A request for a file under /api/export/ (docs/wire.md).
struct ExportRequest {
  ExportFormat format = ExportFormat::Glb;           ///< Of the file.
  std::string content_type;                          ///< MIME type of the response.
  PathDirection direction = PathDirection::Forward;  ///< Reversed: assembly instead of disassembly.
  bool of_guide = false;                             ///< Exports the guide instead of the recording.
};

/// The data to export: a copy, so that the file can be made on any thread.
struct ExportSource {
  std::shared_ptr<const Assembly> assembly;  ///< The open assembly.
  Path path;                                 ///< The recording or the guide; may have no moves.
};

/// Parses a request target; none if it is not an export.
std::optional<ExportRequest> parse_export(const RequestTarget& target);

/// The error that there is nothing to export.
Error no_moves();

/// The recording or the guide as a path; may have no moves. Call on the engine loop's thread. Errors: Usage if there is
/// no guide; Unreadable as of parse_path.
Result<Path> exported_path(const Model& model, PlaybackSource source);

/// Captures the data to export. `model` is null if no assembly is open. Call on the engine loop's thread. Errors: Usage
/// if no assembly is open, or there is no path; Unreadable as of parse_path.
Result<ExportSource> export_source(const ExportRequest& request, const Model* model);

/// Makes the file and the response with it; 500 if that fails. May take seconds. For any thread.
HttpResponse export_response(const ExportRequest& request, const ExportSource& source);

}  // namespace dismantle::server
