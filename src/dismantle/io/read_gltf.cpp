// SPDX-License-Identifier: Apache-2.0
#include "dismantle/io/read_gltf.h"

#include "dismantle/io/gltf_import.h"
#include "dismantle/io/read_file.h"
#include "dismantle/io/sha256.h"

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
