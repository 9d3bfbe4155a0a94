// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/shape_features.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace dismantle {

namespace {

constexpr std::size_t kMostNormals = 12;
constexpr std::size_t kMostAxes = 8;
/// Faces that meet at less [sine] are taken for one plane, whose cross product is noise.
constexpr double kLeastSine = 5e-3;

/// An edge of a face, by its vertices in order, for finding who shares it.
struct HalfEdge {
  std::uint64_t vertices;
  std::uint32_t face;
};

std::vector<HalfEdge> sorted_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = mesh.faces[f].v[k], b = mesh.faces[f].v[(k + 1) % 3];
      edges.push_back({std::min(a, b) << 32 | std::max(a, b), f});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return x.vertices != y.vertices ? x.vertices < y.vertices : x.face < y.face;
  });
  return edges;
}

}  // namespace

ShapeFeatures shape_features(const TriangleMesh& mesh) {
  std::vector<Vec3> area_vectors;
  DirectionClusters normals(Sense::Directed), axes(Sense::Axis);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    area_vectors.push_back(0.5 * normal_unscaled(mesh.triangle(f)));
    const double area = length(area_vectors.back());
    if (area > 0) normals.add(area_vectors.back(), area);
  }
  const std::vector<HalfEdge> edges = sorted_edges(mesh);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].vertices != edges[i + 1].vertices) continue;
    const Vec3 a = area_vectors[edges[i].face], b = area_vectors[edges[i + 1].face];
    const double areas = length(a) * length(b);
    const Vec3 axis = cross(a, b);
    if (areas > 0 && length(axis) > kLeastSine * areas) axes.add(axis, length(axis) / std::sqrt(areas));
  }
  ShapeFeatures features{normals.heaviest(kMostNormals), axes.heaviest(kMostAxes), {}, 0};
  for (const Vec3& p : mesh.vertices) features.center += p / static_cast<double>(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) features.radius = std::max(features.radius, length(p - features.center));
  return features;
}

}  // namespace dismantle
