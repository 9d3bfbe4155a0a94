// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/collada/read_collada.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/formats/collada/collada_import.h"
#include "dismantle/formats/import/mesh_source.h"
#include "dismantle/formats/import/units.h"

namespace dismantle {

Result<Assembly> read_collada(const std::filesystem::path& file, const ImportOptions& options) {
  if (!options.units.empty())
    if (const Result<double> known = millimetres_per_unit(options.units); !known) return known.error();
  const Result<std::string> bytes = read_file(file, options.limits.file_bytes);
  if (!bytes) return bytes.error();
  Result<Assembly> assembly = import_collada(*bytes, file.filename().string(), options);
  if (!assembly) return unreadable_as(file, "COLLADA", assembly.error());
  assembly->source_file = file.filename().string();
  assembly->source_sha256 = sha256(*bytes);
  return assembly;
}

}  // namespace dismantle
