// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/shape_features.h"

#include "dismantle/geometry/adjacency.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

constexpr std::size_t kMaxNormals = 12;
constexpr std::size_t kMaxAxes = 8;
/// Faces that meet at a smaller angle [sine] count as one plane; their cross product is noise.
constexpr double kMinSine = 5e-3;

}  // namespace

ShapeFeatures shape_features(const TriangleMesh& mesh) {
  std::vector<Vec3> area_vectors;
  DirectionClusters normals(Sense::Directed), axes(Sense::Axis);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    area_vectors.push_back(0.5 * normal_unscaled(mesh.triangle(f)));
    const double area = length(area_vectors.back());
    if (area > 0) normals.add(area_vectors.back(), area);
  }
  for (const NeighbouringFaces& pair : neighbouring_faces(mesh.faces)) {
    const Vec3 a = area_vectors[pair.face[0]], b = area_vectors[pair.face[1]];
    const double areas = length(a) * length(b);
    const Vec3 axis = cross(a, b);
    if (areas > 0 && length(axis) > kMinSine * areas) axes.add(axis, length(axis) / std::sqrt(areas));
  }
  ShapeFeatures features{normals.heaviest(kMaxNormals), axes.heaviest(kMaxAxes), {}, 0, 0, {}};
  for (const Vec3& a : area_vectors) features.area += length(a);
  for (const Vec3& p : mesh.vertices) features.center += p / static_cast<double>(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) features.bounds.extend(p);
  for (const Vec3& p : mesh.vertices) features.radius = std::max(features.radius, length(p - features.center));
  return features;
}

std::vector<ShapeFeatures> shape_features(const Assembly& assembly, const Executor& executor) {
  std::vector<ShapeFeatures> features(assembly.components.size());
  executor.for_each_heavy(features.size(),
                          [&](std::size_t c) { features[c] = shape_features(assembled_mesh(assembly.components[c])); });
  return features;
}

SphereTree sphere_tree(Span<const ShapeFeatures> features) {
  std::vector<BoundingSphere> spheres;
  spheres.reserve(features.size());
  for (const ShapeFeatures& f : features) spheres.push_back({f.center, f.radius});
  return SphereTree(spheres);
}

}  // namespace dismantle
