// SPDX-License-Identifier: Apache-2.0
// dismantle-read-cad: reads a CAD, COLLADA or URDF file for load_assembly().
#include "dismantle/formats/cad/read_cad.h"
#include "dismantle/formats/collada/read_collada.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/formats/urdf/read_urdf.h"
#include "dismantle/loading/run_reader.h"

namespace {

using namespace dismantle;

Result<ImportedAssembly> read_model(const std::filesystem::path& file, const ImportOptions& options) {
  if (is_cad_file(file)) return read_cad(file, options);
  const FormatEntry* format = format_of(file);
  if (format != nullptr && format->format == FileFormat::Urdf) return read_urdf(file, options);
  Result<Assembly> assembly = read_collada(file, options);
  if (!assembly) return assembly.error();
  return ImportedAssembly{std::move(*assembly), {}};
}

}  // namespace

int main() {
  return run_reader(read_model);
}
