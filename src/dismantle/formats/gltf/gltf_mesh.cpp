// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/gltf_mesh.h"

#include "dismantle/formats/gltf/gltf_elements.h"

#include <algorithm>

namespace dismantle {

namespace {

Error broken(const std::string& file_name, std::size_t mesh, const std::string& why) {
  return {ErrorKind::Unreadable,
          file_name + " cannot be used (mesh " + std::to_string(mesh) + " " + why + "); export it again"};
}

std::size_t triangle_count(GltfMode mode, std::size_t corners) {
  if (mode == GltfMode::Triangles) return corners / 3;
  return corners < 3 ? 0 : corners - 2;
}

/// The three corners of a primitive that form its triangle `t`.
Face corners_of(GltfMode mode, std::uint32_t t) {
  switch (mode) {
    case GltfMode::Strip:
      return t % 2 == 0 ? Face{{t, t + 1, t + 2}} : Face{{t, t + 2, t + 1}};
    case GltfMode::Fan:
      return {{t + 1, t + 2, 0}};
    default:
      return {{3 * t, 3 * t + 1, 3 * t + 2}};
  }
}

/// Appends a primitive and the vertices that it uses to a mesh, and returns its area, or the reason of an Error.
Result<double> append(const GltfPrimitive& primitive, const GltfElements& positions, const GltfElements* indices,
                      TriangleMesh& mesh) {
  const std::size_t corners = indices ? indices->count() : positions.count();
  const std::size_t first_face = mesh.faces.size(), first_vertex = mesh.vertices.size();
  const std::size_t triangles = triangle_count(primitive.mode, corners);
  std::vector<std::uint32_t> used;
  used.reserve(3 * triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    Face face = corners_of(primitive.mode, static_cast<std::uint32_t>(t));
    for (std::uint32_t& v : face.v) {
      if (indices) v = indices->index(v);
      if (v >= positions.count()) return Error{ErrorKind::Unreadable, "has an index beyond its positions"};
      used.push_back(v);
    }
    mesh.faces.push_back(face);
  }

  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::uint32_t v : used) {
    mesh.vertices.push_back(positions.vec3(v));
    if (!is_finite(mesh.vertices.back())) return Error{ErrorKind::Unreadable, "has a position that is no number"};
  }
  double twice_area = 0;
  for (std::size_t f = first_face; f < mesh.faces.size(); ++f) {
    for (std::uint32_t& v : mesh.faces[f].v)
      v = static_cast<std::uint32_t>(
          first_vertex + static_cast<std::size_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin()));
    twice_area += length(normal_unscaled(mesh.triangle(f)));
  }
  return twice_area / 2;
}

}  // namespace

Result<SceneMesh> read_gltf_mesh(const GltfDocument& document, std::size_t mesh,
                                 const std::vector<std::string_view>& buffers, const std::string& file_name,
                                 std::size_t triangle_limit) {
  SceneMesh surface;
  std::vector<double> area_of(document.materials.size() + 1, 0.0);  // the last: without material
  for (const GltfPrimitive& primitive : document.meshes[mesh].primitives) {
    const Result<GltfElements> positions = GltfElements::open(document, primitive.positions, buffers, file_name);
    if (!positions) return positions.error();
    std::optional<GltfElements> indices;
    if (primitive.indices) {
      const Result<GltfElements> opened = GltfElements::open(document, *primitive.indices, buffers, file_name);
      if (!opened) return opened.error();
      indices = *opened;
    }
    const std::size_t corners = indices ? indices->count() : positions->count();
    if (triangle_count(primitive.mode, corners) > triangle_limit - surface.mesh.faces.size() ||
        surface.mesh.vertices.size() + corners >= Id<VertexTag>::kInvalid)
      return broken(file_name, mesh, "has more than " + std::to_string(triangle_limit) + " triangles");
    const Result<double> area = append(primitive, *positions, indices ? &*indices : nullptr, surface.mesh);
    if (!area) return broken(file_name, mesh, area.error().message);
    area_of[primitive.material.value_or(document.materials.size())] += *area;
  }
  const auto largest = static_cast<std::size_t>(std::max_element(area_of.begin(), area_of.end()) - area_of.begin());
  if (largest < document.materials.size()) surface.color = document.materials[largest];
  return surface;
}

}  // namespace dismantle
