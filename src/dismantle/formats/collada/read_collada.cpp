// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/collada/read_collada.h"

#include "dismantle/files/read_file.h"
#include "dismantle/formats/collada/collada_import.h"
#include "dismantle/formats/import/isolated_import.h"
#include "dismantle/formats/import/units.h"

namespace dismantle {

namespace {

/// Increased whenever the same file and options give another assembly.
constexpr int kImportVersion = 1;

}  // namespace

Result<Assembly> read_collada(const std::filesystem::path& file, const ImportOptions& options) {
  if (!options.units.empty())
    if (const Result<double> known = millimetres_per_unit(options.units); !known) return known.error();
  if (collada_reader().empty())
    return unreadable_as(file, "COLLADA", "this dismantle was built without Assimp",
                         "build it where libassimp-dev is installed, or convert the file to glTF");
  const Result<std::string> bytes = read_file(file, options.limits.file_bytes);
  if (!bytes) return bytes.error();

  IsolatedImport importer;
  importer.format = "COLLADA";
  importer.reader = "Assimp";
  importer.version = std::to_string(kImportVersion) + '\n' + DISMANTLE_VERSION + '\n' + collada_reader();
  importer.limits.memory_bytes = kColladaMemoryBase + kColladaMemoryPerByte * bytes->size();
  importer.limits.cpu_seconds = kColladaCpuSeconds;
  importer.import = [&](const ImportOptions& child_options) -> Result<ImportedAssembly> {
    Result<Assembly> assembly = import_collada(*bytes, file.filename().string(), child_options);
    if (!assembly) return assembly.error();
    return ImportedAssembly{std::move(*assembly), {}};
  };
  return import_isolated(file, *bytes, importer, options);
}

}  // namespace dismantle
