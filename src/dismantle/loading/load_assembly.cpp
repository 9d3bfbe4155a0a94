// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/load_assembly.h"

#include "dismantle/assembly/assembly_file.h"
#include "dismantle/assembly/duplicates.h"
#include "dismantle/files/text_name.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/formats/cad/read_cad.h"
#include "dismantle/formats/collada/read_collada.h"
#include "dismantle/formats/gltf/read_gltf.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/formats/import/units.h"
#include "dismantle/formats/mesh/read_mesh.h"
#include "dismantle/formats/threemf/read_3mf.h"
#include "dismantle/formats/urdf/read_urdf.h"
#include "dismantle/formats/vrml/read_vrml.h"

#include <map>
#include <new>
#include <stdexcept>

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

/// A `.dasm` file: it keeps the name and the hash of the file that it was converted from.
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

Result<Assembly> dispatch(const fs::path& file, const ImportOptions& options) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  if (fs::is_directory(status)) return read_mesh_folder(file, options);
  if (!fs::exists(status))
    return Error{ErrorKind::Unreadable, file.string() + " cannot be read (no such file); check the path"};

  const FormatEntry* entry = format_of(file);
  const std::string extension = lower_case(file.extension().string());
  if (entry == nullptr)
    return Error{ErrorKind::Unreadable,
                 file.string() + " cannot be read (" +
                     (extension.empty() ? "it has no file extension"
                                        : "dismantle cannot read files with the extension " + in_quotes(extension)) +
                     "); convert it to " + format_names() + ", or give a folder of meshes"};
  switch (entry->format) {
    case FileFormat::Gltf:
      return read_gltf(file, options);
    case FileFormat::ThreeMf:
      return read_3mf(file, options);
    case FileFormat::Collada:
      return read_collada(file, options);
    case FileFormat::Vrml:
      return read_vrml(file, options);
    case FileFormat::Urdf:
      return read_urdf(file, options);
    case FileFormat::Dasm:
      return read_dasm(file, options);
    case FileFormat::Obj:
    case FileFormat::Stl:
    case FileFormat::Ply:
      return read_mesh(file, options);
    default:
      return read_cad(file, options);
  }
}

/// Names from files may contain any bytes; after this they are safe in JSON and on a terminal.
void clean_names(Assembly& assembly) {
  for (TreeNode& node : assembly.tree) node.name = clean_name(node.name);
  for (Component& component : assembly.components) component.name = clean_name(component.name);
  make_names_unique(assembly.components);
}

}  // namespace

Result<Assembly> load_assembly(const fs::path& file, const ImportOptions& options) {
  try {
    Result<Assembly> assembly = dispatch(file, options);
    if (!assembly) return assembly;
    if (const Result<Done> sane = check_coordinates(*assembly); !sane) return sane.error();
    clean_names(*assembly);
    if (options.drop_duplicates) {
      std::vector<ComponentId> duplicates;
      for (const Duplicate& d : find_duplicates(*assembly)) duplicates.push_back(d.component);
      remove_components(*assembly, duplicates);
    }
    return assembly;
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::Failed, file.string() + " cannot be loaded (out of memory); simplify it or free memory"};
  } catch (const std::length_error&) {
    return Error{ErrorKind::Failed, file.string() + " cannot be loaded (out of memory); simplify it or free memory"};
  }
}

}  // namespace dismantle
