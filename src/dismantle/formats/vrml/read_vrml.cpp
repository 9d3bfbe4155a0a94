// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/vrml/read_vrml.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/formats/import/units.h"
#include "dismantle/formats/vrml/vrml_scene.h"

#include <utility>

namespace dismantle {

Result<Assembly> import_vrml(const MeshSource& source, const ImportOptions& options) {
  const std::string units = options.units.empty() ? "m" : options.units;
  const Result<double> scale = millimetres_per_unit(units);
  if (!scale) return scale.error();
  if (!report_progress(options.progress, "reading", -1)) return cancelled();
  Result<VrmlScene> scene = parse_vrml(source, options.limits.triangles);
  if (!scene) return scene.error();
  const SceneMeshLoader load = [&](std::size_t mesh, std::size_t) -> Result<SceneMesh> {
    return std::move(scene->meshes[mesh]);
  };
  Result<Assembly> assembly = assembly_from_scene(scene->scene, {source.name, *scale}, load, options);
  if (!assembly) return assembly;
  assembly->source_units = units;
  assembly->deflection = scene->deflection * *scale;
  return assembly;
}

Result<Assembly> read_vrml(const std::filesystem::path& file, const ImportOptions& options) {
  const Result<std::string> bytes = read_file(file, options.limits.file_bytes);
  if (!bytes) return bytes.error();
  Result<Assembly> assembly = import_vrml({*bytes, file.filename().string()}, options);
  if (assembly) assembly->source_sha256 = sha256(*bytes);
  return assembly;
}

}  // namespace dismantle
