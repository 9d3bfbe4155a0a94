// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/render_mesh.h"

#include "dismantle/geometry/half_edges.h"
#include "dismantle/math/vec3f.h"

#include <cmath>
#include <cstddef>

namespace dismantle {

namespace {

/// The faces around each vertex v: faces[first[v]] up to, not including, faces[first[v + 1]].
struct VertexFaces {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> faces;
};

VertexFaces vertex_faces(const TriangleMesh& mesh) {
  VertexFaces around;
  around.first.assign(mesh.vertices.size() + 1, 0);
  for (const Face& f : mesh.faces)
    for (const std::uint32_t v : f.v) ++around.first[v + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) around.first[v + 1] += around.first[v];
  around.faces.resize(around.first.back());
  std::vector<std::uint32_t> next(around.first.begin(), around.first.end() - 1);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t v : mesh.faces[f].v) around.faces[next[v]++] = f;
  return around;
}

std::vector<FeatureEdge> find_feature_edges(const TriangleMesh& mesh, const std::vector<Vec3>& unit_normals,
                                            double smooth_cosine) {
  std::vector<FeatureEdge> features;
  for_each_edge(sorted_half_edges(mesh.faces), [&](const HalfEdge* first, const HalfEdge* last) {
    const std::uint32_t f = first->face, g = (last - 1)->face;
    if (last - first != 2 || dot(unit_normals[f], unit_normals[g]) < smooth_cosine)
      features.push_back({{first->low, first->high}, {f, g}});
  });
  return features;
}

}  // namespace

RenderMesh make_render_mesh(TriangleMesh mesh, double crease_angle) {
  RenderMesh result;
  result.mesh = std::move(mesh);
  const TriangleMesh& m = result.mesh;
  const double smooth_cosine = std::cos(crease_angle);

  std::vector<Vec3> area_normals, unit_normals;
  for (std::size_t f = 0; f < m.faces.size(); ++f) {
    area_normals.push_back(normal_unscaled(m.triangle(f)));
    unit_normals.push_back(normalized(area_normals.back()));
  }

  const VertexFaces around = vertex_faces(m);
  result.corner_normals.reserve(3 * m.faces.size());
  for (std::size_t f = 0; f < m.faces.size(); ++f) {
    for (const std::uint32_t v : m.faces[f].v) {
      Vec3 sum = area_normals[f];
      for (std::uint32_t i = around.first[v]; i < around.first[v + 1]; ++i) {
        const std::uint32_t g = around.faces[i];
        if (g != f && dot(unit_normals[f], unit_normals[g]) > smooth_cosine) sum += area_normals[g];
      }
      result.corner_normals.push_back(to_float(normalized(sum)));
    }
  }
  result.feature_edges = find_feature_edges(m, unit_normals, smooth_cosine);
  return result;
}

}  // namespace dismantle
