// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/collada/collada_import.h"

#include "dismantle/files/text_name.h"
#include "dismantle/formats/import/scene_assembly.h"
#include "dismantle/formats/import/units.h"
#include "dismantle/formats/mesh/polygon.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <vector>

namespace dismantle {

namespace {

constexpr std::size_t kLongestReason = 200;

Error unreadable(const std::string& problem) {
  return {ErrorKind::Unreadable, problem};
}

/// A number that a library keeps as a float, as the decimal number that it was read from.
double decimal_of(float value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.7g", static_cast<double>(value));
  return std::strtod(digits, nullptr);
}

SceneTransform transform_of(const aiMatrix4x4& m) {
  return {{{{m.a1, m.a2, m.a3}, {m.b1, m.b2, m.b3}, {m.c1, m.c2, m.c3}}}, {m.a4, m.b4, m.c4}};
}

Color color_of(const aiMaterial& material) {
  aiColor4D diffuse;
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) != AI_SUCCESS) return {};
  const auto channel = [](float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 0.0f; };
  return {channel(diffuse.r), channel(diffuse.g), channel(diffuse.b), 1};
}

/// Collects the nodes of Assimp's scene. A node has several meshes if it has several materials; together they are one
/// of ours.
class SceneConverter {
 public:
  SceneConverter(const aiScene& source, const std::string& name) : source_(source) {
    scene_.roots.push_back(add(*source.mRootNode));
    scene_.nodes[0].name = name;
    scene_.nodes[0].parent_from_node = {};  // the unit, which is applied apart
  }

  const Scene& scene() const { return scene_; }

  Result<SceneMesh> mesh(std::size_t index, std::size_t triangle_limit) const {
    SceneMesh result;
    PolygonTriangulator triangulator;
    double largest = -1;
    for (const unsigned part : meshes_[index]) {
      const aiMesh& mesh = *source_.mMeshes[part];
      const auto first = static_cast<std::uint32_t>(result.mesh.vertices.size());
      for (unsigned v = 0; v < mesh.mNumVertices; ++v)
        result.mesh.vertices.push_back({mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z});
      const std::size_t first_face = result.mesh.faces.size();
      for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices < 3) continue;  // a point or a line
        std::vector<std::uint32_t> corners;
        for (unsigned k = 0; k < face.mNumIndices; ++k) corners.push_back(first + face.mIndices[k]);
        if (std::any_of(corners.begin(), corners.end(), [&](auto v) { return v >= result.mesh.vertices.size(); }))
          return unreadable("an index of its polygons is out of range; export it again");
        triangulator.append(corners, result.mesh.vertices, result.mesh.faces);
        if (result.mesh.faces.size() > triangle_limit)
          return unreadable("it has more triangles than the limit; simplify it");
      }
      double area = 0;
      for (std::size_t f = first_face; f < result.mesh.faces.size(); ++f)
        area += length(normal_unscaled(result.mesh.triangle(f)));
      if (area > largest && mesh.mMaterialIndex < source_.mNumMaterials)
        result.color = color_of(*source_.mMaterials[mesh.mMaterialIndex]);
      largest = std::max(largest, area);
    }
    return result;
  }

 private:
  std::size_t add(const aiNode& node) {
    const std::size_t index = scene_.nodes.size();
    scene_.nodes.emplace_back();
    SceneNode converted;
    converted.name = std::string(node.mName.data, node.mName.length);
    converted.parent_from_node = transform_of(node.mTransformation);
    if (node.mNumMeshes > 0) {
      const std::vector<unsigned> parts(node.mMeshes, node.mMeshes + node.mNumMeshes);
      const auto [place, is_new] = mesh_index_.try_emplace(parts, meshes_.size());
      if (is_new) meshes_.push_back(parts);
      converted.mesh = place->second;
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) converted.children.push_back(add(*node.mChildren[i]));
    scene_.nodes[index] = std::move(converted);
    return index;
  }

  const aiScene& source_;
  Scene scene_;
  std::vector<std::vector<unsigned>> meshes_;  // Assimp's meshes, by ours
  std::map<std::vector<unsigned>, std::size_t> mesh_index_;
};

}  // namespace

Result<Assembly> import_collada(std::string_view bytes, const std::string& name, const ImportOptions& options) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  report_progress(options.progress, "reading", -1);
  const aiScene* source = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "dae");
  if (source == nullptr || source->mRootNode == nullptr) {
    std::string why = clean_name(importer.GetErrorString()).substr(0, kLongestReason);
    std::replace(why.begin(), why.end(), ';', ',');
    return unreadable(clean_name(why.empty() ? "it holds no scene" : why) + "; export it again");
  }
  // With the up direction ignored, the root scales to metres, and does nothing else.
  const double metres = decimal_of(source->mRootNode->mTransformation.a1);
  const LengthUnit unit = length_unit_of(1000 * metres);
  const double scale = options.units.empty() ? unit.millimetres : *millimetres_per_unit(options.units);

  report_progress(options.progress, "building", -1);
  const SceneConverter converter(*source, name);
  const SceneMeshLoader load = [&](std::size_t mesh, std::size_t limit) { return converter.mesh(mesh, limit); };
  Result<Assembly> assembly = assembly_from_scene(converter.scene(), {name, scale}, load, options);
  if (!assembly) {  // "<name> is too large (<why>); <what to do>"
    const std::string& message = assembly.error().message;
    return unreadable(message.starts_with(name) ? "it" + message.substr(name.size()) : message);
  }
  assembly->source_units = options.units.empty() ? unit.name : options.units;
  return assembly;
}

}  // namespace dismantle
