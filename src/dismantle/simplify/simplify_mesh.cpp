// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/simplify_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <vector>

namespace dismantle {

namespace {

// A solid that keeps less than this part of its volume has collapsed into a sheet.
constexpr double kLeastVolume = 0.5;
// Of the way from the target back to the original's count, for each further try.
constexpr double kBackOff[] = {0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7};

/// Positions about the box's middle in units of its size, where single precision is finest.
std::vector<float> float_positions(const TriangleMesh& mesh) {
  const Aabb box = bounds(mesh);
  const Vec3 middle = box.center();
  const double scale = 1 / std::max(max_abs(box.size()), 1e-300);
  std::vector<float> positions;
  positions.reserve(3 * mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) {
    const Vec3 p = scale * (v - middle);
    for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(p[k]));
  }
  return positions;
}

TriangleMesh collapsed(const TriangleMesh& mesh, const std::vector<float>& positions, std::size_t target_triangles) {
  std::vector<unsigned int> indices;
  indices.reserve(3 * mesh.faces.size());
  for (const Face& f : mesh.faces) indices.insert(indices.end(), f.v, f.v + 3);
  std::vector<unsigned int> result(indices.size());
  constexpr float kAnyError = 1e3f;  // the triangle count decides; relative to the mesh's size
  result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), positions.data(), mesh.vertices.size(),
                                 3 * sizeof(float), 3 * target_triangles, kAnyError, 0, nullptr));
  TriangleMesh simplified{mesh.vertices, {}};
  for (std::size_t i = 0; i < result.size(); i += 3)
    simplified.faces.push_back({{result[i], result[i + 1], result[i + 2]}});
  return simplified;
}

/// True where the mesh is closed, consistently oriented, without degenerate triangles, and has that volume at least.
bool is_solid(const CleanedMesh& cleaned, double least_volume) {
  return !cleaned.mesh.faces.empty() && cleaned.faults.closed() && cleaned.faults.degenerate_faces == 0 &&
         signed_volume(cleaned.mesh) > least_volume;
}

}  // namespace

TriangleMesh simplify_mesh(const TriangleMesh& mesh, std::size_t target_triangles) {
  if (mesh.faces.size() <= target_triangles) return mesh;
  const std::vector<float> positions = float_positions(mesh);
  const bool must_stay_solid = is_solid(clean_mesh(mesh), 0);
  const double least_volume = kLeastVolume * signed_volume(mesh);
  const auto excess = static_cast<double>(mesh.faces.size() - target_triangles);
  for (const double back : kBackOff) {
    const auto target = target_triangles + static_cast<std::size_t>(back * excess);
    CleanedMesh cleaned = clean_mesh(collapsed(mesh, positions, target));
    const bool acceptable = must_stay_solid ? is_solid(cleaned, least_volume) : !cleaned.mesh.faces.empty();
    if (acceptable) return cleaned.mesh.faces.size() < mesh.faces.size() ? std::move(cleaned.mesh) : mesh;
  }
  return mesh;
}

}  // namespace dismantle
