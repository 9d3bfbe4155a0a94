// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/read_gltf.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/formats/gltf/gltf_import.h"

namespace dismantle {

Result<Assembly> read_gltf(const std::filesystem::path& file, const ImportOptions& options) {
  const Result<std::string> bytes = read_file(file, options.limits.file_bytes);
  if (!bytes) return bytes.error();
  const auto load = [&](const std::string& uri, std::size_t limit) {
    return read_file(file.parent_path() / uri, limit);
  };
  Result<Assembly> assembly = import_gltf(*bytes, file.filename().string(), load, options);
  if (assembly) assembly->source_sha256 = sha256(*bytes);
  return assembly;
}

}  // namespace dismantle
