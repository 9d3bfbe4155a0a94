// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/threemf/read_3mf.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/files/zip_archive.h"
#include "dismantle/formats/import/mesh_source.h"
#include "dismantle/formats/threemf/threemf_import.h"

namespace dismantle {

Result<Assembly> read_3mf(const std::filesystem::path& file, const ImportOptions& options) {
  const Result<std::string> bytes = read_file(file, options.limits.file_bytes);
  if (!bytes) return bytes.error();
  const std::string name = file.filename().string();
  Result<ZipArchive> archive = ZipArchive::open(*bytes);
  if (!archive) {
    const std::string& message = archive.error().message;
    return malformed({{}, name}, "3MF", message.substr(0, message.rfind("; ")));
  }
  Result<Assembly> assembly = import_3mf(
      name, [&](const std::string& part) { return archive->read(part); }, options);
  if (assembly) assembly->source_sha256 = sha256(*bytes);
  return assembly;
}

}  // namespace dismantle
