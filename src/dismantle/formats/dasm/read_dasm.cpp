// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/dasm/read_dasm.h"

#include "dismantle/assembly/assembly_file.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/import/units.h"

#include <map>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

/// Cleans the meshes of an assembly, each shared one once, and scales everything by `scale`.
void clean_and_scale(Assembly& assembly, double scale) {
  std::map<std::shared_ptr<const TriangleMesh>, CleanedMesh> cleaned;
  for (Component& component : assembly.components) {
    const auto [at, is_new] = cleaned.try_emplace(component.mesh);
    if (is_new) {
      TriangleMesh scaled = *component.mesh;
      for (Vec3& vertex : scaled.vertices) vertex *= scale;
      at->second = clean_mesh(scaled);
    }
    const MeshFaults as_read = component.faults;
    component.faults = at->second.faults;
    component.faults.welded_vertices += as_read.welded_vertices;
    component.faults.degenerate_faces += as_read.degenerate_faces;
    component.assembly_from_mesh.translation *= scale;
  }
  std::map<const TriangleMesh*, std::shared_ptr<const TriangleMesh>> shared;
  for (auto& [original, mesh] : cleaned)
    shared[original.get()] = std::make_shared<const TriangleMesh>(std::move(mesh.mesh));
  std::erase_if(assembly.components, [&](Component& component) {
    component.mesh = shared[component.mesh.get()];
    return component.mesh->faces.empty();
  });
}

}  // namespace

Result<Assembly> read_dasm(const fs::path& file, const ImportOptions& options) {
  Result<AssemblyFile> read = read_assembly_file(file, options.limits.file_bytes);
  if (!read) return read.error();
  Assembly& assembly = read->assembly;
  const Result<double> scale = millimetres_per_unit(options.units.empty() ? "mm" : options.units);
  if (!scale) return scale.error();
  if (!options.units.empty()) assembly.source_units = options.units;
  clean_and_scale(assembly, *scale);
  const auto refused = [&file](const char* why, const char* advice) {
    return Error{ErrorKind::Unreadable, file.string() + " cannot be loaded (" + why + "); " + advice};
  };
  if (assembly.components.empty()) return refused("it has no component with triangles", "convert it again");
  if (assembly.components.size() > options.limits.components || triangle_count(assembly) > options.limits.triangles)
    return refused("it has too many components or triangles", "simplify it or load a part of it");
  return std::move(assembly);
}

}  // namespace dismantle
