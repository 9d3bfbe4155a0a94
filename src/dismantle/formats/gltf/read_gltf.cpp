// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/read_gltf.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/formats/gltf/gltf_import.h"
#include "dismantle/formats/import/mesh_source.h"
#include "dismantle/formats/import/referenced_file.h"

namespace dismantle {

Result<Assembly> read_gltf(const std::filesystem::path& file, const ImportOptions& options) {
  const Result<std::string> bytes = read_file(file, options.limits.file_bytes);
  if (!bytes) return bytes.error();
  const std::vector<std::filesystem::path> folders = reference_folders(file, options);
  const auto load = [&](const std::string& uri, std::size_t limit) -> Result<std::string> {
    const Result<std::filesystem::path> beside = referenced_file(uri, file.parent_path(), folders);
    if (!beside) {
      const std::string why = "it refers to " + in_quotes(uri) + ", which " + beside.error().message;
      return unreadable_as(file.filename(), "glTF", {ErrorKind::Unreadable, why});
    }
    return read_file(*beside, limit);
  };
  Result<Assembly> assembly = import_gltf(*bytes, file.filename().string(), load, options);
  if (assembly) assembly->source_sha256 = sha256(*bytes);
  return assembly;
}

}  // namespace dismantle
