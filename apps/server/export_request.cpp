// SPDX-License-Identifier: Apache-2.0
#include "apps/server/export_request.h"

#include "apps/server/lack_of_memory.h"
#include "apps/server/viewer_files.h"
#include "dismantle/documents/path_file.h"

#include <exception>

namespace dismantle::server {

namespace {

constexpr std::string_view kExportPrefix = "/api/export/";

struct ExportName {
  std::string_view name;
  ExportFormat format;
  std::string_view content_type;
};

constexpr ExportName kNames[] = {
    {"animation.glb", ExportFormat::Glb, "model/gltf-binary"},
    {"page.html", ExportFormat::Html, "application/octet-stream"},  // never shown from here
    {"moves.csv", ExportFormat::Moves, "text/csv; charset=utf-8"},
    {"bom.csv", ExportFormat::BillCsv, "text/csv; charset=utf-8"},
    {"bom.json", ExportFormat::BillJson, "application/json"},
    {"path.json", ExportFormat::Path, "application/json"}};

bool has(const RequestTarget& target, const std::string& name, std::string_view value) {
  const auto found = target.query.find(name);
  return found != target.query.end() && found->second == value;
}

}  // namespace

std::optional<ExportRequest> parse_export(const RequestTarget& target) {
  if (target.path.compare(0, kExportPrefix.size(), kExportPrefix) != 0) return {};
  for (const ExportName& known : kNames) {
    if (target.path.compare(kExportPrefix.size(), std::string::npos, known.name) != 0) continue;
    const bool is_reversed = has(target, "reverse", "1") && depends_on_direction(known.format);
    return ExportRequest{known.format, std::string(known.content_type),
                         is_reversed ? PathDirection::Reversed : PathDirection::Forward,
                         has(target, "source", "guide")};
  }
  return {};
}

Error no_moves() {
  return {ErrorKind::Usage, "there is no path to export (nothing was moved yet); move something first"};
}

Result<Path> exported_path(const Model& model, PlaybackSource source) {
  if (source == PlaybackSource::Recording) return model.session->recording();
  const Guide* guide = model.session->guide();
  if (guide == nullptr)
    return Error{ErrorKind::Usage, "there is no guide to export (no path file is open); open one first"};
  return parse_path(guide->text, guide->name);
}

Result<ExportSource> export_source(const ExportRequest& request, const Model* model) {
  if (model == nullptr)
    return Error{ErrorKind::Usage, "there is nothing to export (no assembly is open); open one first"};
  Result<Path> path = exported_path(*model, request.of_guide ? PlaybackSource::Guide : PlaybackSource::Recording);
  if (!path) return path.error();
  if (needs_path(request.format) && path->moves.empty()) return no_moves();
  return ExportSource{model->assembly, std::move(*path)};
}

HttpResponse export_response(const ExportRequest& request, const ExportSource& source) {
  ExportOptions options;
  options.direction = request.direction;
  options.viewer = viewer_files();
  try {
    Result<std::string> file = exported_file(request.format, *source.assembly, source.path, options);
    if (!file) return error_response(500, file.error().message);
    return {200, request.content_type, std::make_shared<const std::string>(std::move(*file)), {}};
  } catch (const std::exception& error) {
    if (!is_lack_of_memory(error)) throw;
    return error_response(507, "the export cannot be made (out of memory); simplify the assembly or free memory");
  }
}

}  // namespace dismantle::server
