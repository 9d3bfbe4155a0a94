// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/render_mesh.h"

#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dismantle {

namespace {

/// The triangles around each vertex: those of vertex v are faces[first[v]] to faces[first[v + 1]].
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

struct HalfEdge {
  std::uint32_t low, high, face;
};

std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.faces[f].v[k], b = mesh.faces[f].v[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), f});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.face < b.face;
  });
  return edges;
}

std::vector<FeatureEdge> find_feature_edges(const TriangleMesh& mesh, const std::vector<Vec3>& unit_normals,
                                            double smooth_cosine) {
  std::vector<FeatureEdge> features;
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    const std::uint32_t f = edges[i].face, g = edges[j - 1].face;
    if (j - i != 2 || dot(unit_normals[f], unit_normals[g]) < smooth_cosine)
      features.push_back({{edges[i].low, edges[i].high}, {f, g}});
    i = j;
  }
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
