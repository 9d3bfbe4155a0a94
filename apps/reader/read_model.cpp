// SPDX-License-Identifier: Apache-2.0
// dismantle-read: reads a file, or a folder of meshes, for load_assembly().
#include "dismantle/formats/dasm/read_dasm.h"
#include "dismantle/formats/gltf/read_gltf.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/formats/mesh/read_mesh.h"
#include "dismantle/formats/threemf/read_3mf.h"
#include "dismantle/formats/vrml/read_vrml.h"
#include "dismantle/loading/run_reader.h"

namespace {

using namespace dismantle;

Result<Assembly> read_any(const std::filesystem::path& file, const ImportOptions& options) {
  std::error_code ignored;
  const FormatEntry* entry = format_of(file);
  if (entry == nullptr || std::filesystem::is_directory(file, ignored)) return read_mesh_folder(file, options);
  switch (entry->format) {
    case FileFormat::Gltf:
      return read_gltf(file, options);
    case FileFormat::ThreeMf:
      return read_3mf(file, options);
    case FileFormat::Vrml:
      return read_vrml(file, options);
    case FileFormat::Dasm:
      return read_dasm(file, options);
    default:
      return read_mesh(file, options);
  }
}

Result<ImportedAssembly> read_model(const std::filesystem::path& file, const ImportOptions& options) {
  Result<Assembly> assembly = read_any(file, options);
  if (!assembly) return assembly.error();
  return ImportedAssembly{std::move(*assembly), {}};
}

}  // namespace

int main() {
  return run_reader(read_model);
}
