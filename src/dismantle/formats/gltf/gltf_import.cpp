// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/gltf_import.h"

#include "dismantle/formats/gltf/gltf_container.h"
#include "dismantle/formats/gltf/gltf_mesh.h"
#include "dismantle/formats/import/scene_assembly.h"
#include "dismantle/formats/import/units.h"

#include <utility>

namespace dismantle {

namespace {

/// The nodes of a document; those without a name are named after their mesh.
Scene scene_of(const GltfDocument& document) {
  Scene scene{document.nodes, document.roots};
  for (SceneNode& node : scene.nodes)
    if (node.name.empty() && node.mesh) node.name = document.meshes[*node.mesh].name;
  return scene;
}

}  // namespace

Result<Assembly> import_gltf(std::string_view bytes, const std::string& name, const GltfFileLoader& load,
                             const ImportOptions& options) {
  const std::string units = options.units.empty() ? "m" : options.units;
  const Result<double> scale = millimetres_per_unit(units);
  if (!scale) return scale.error();
  const Result<GltfContainer> container = open_gltf_container(bytes, name);
  if (!container) return container.error();
  const Result<GltfDocument> document = parse_gltf(container->json, name);
  if (!document) return document.error();
  const Result<GltfBuffers> buffers = load_gltf_buffers(*document, *container, name, load, options.limits.file_bytes);
  if (!buffers) return buffers.error();
  const SceneMeshLoader load_mesh = [&](std::size_t mesh, std::size_t triangle_limit) {
    return read_gltf_mesh(*document, mesh, buffers->bytes, name, triangle_limit);
  };
  Result<Assembly> assembly = assembly_from_scene(scene_of(*document), {name, *scale}, load_mesh, options);
  if (assembly) assembly->source_units = units;
  return assembly;
}

}  // namespace dismantle
