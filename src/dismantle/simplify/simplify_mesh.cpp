// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/simplify_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dismantle {

namespace {

// A solid that keeps less than this part of its volume has collapsed into a sheet.
constexpr double kLeastVolume = 0.5;
// Of the way from the goal back to the original's count, for each further try.
constexpr double kBackOff[] = {0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7};
// Times that the surroundings of new faults are left out of the collapses, before a try counts as failed.
constexpr int kRepairRounds = 12;

/// A mesh as meshoptimizer wants it: single precision, about the box's middle in units of its size, where that is
/// finest.
class CollapseInput {
 public:
  explicit CollapseInput(const TriangleMesh& mesh) : mesh_(mesh) {
    const Aabb box = bounds(mesh);
    const Vec3 middle = box.center();
    size_ = std::max(max_abs(box.size()), 1e-300);
    positions_.reserve(3 * mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) {
      const Vec3 p = (v - middle) / size_;
      for (int k = 0; k < 3; ++k) positions_.push_back(static_cast<float>(p[k]));
    }
  }

  const TriangleMesh& mesh() const { return mesh_; }

  /// The faces left by the collapses, over the same vertices; those that are `kept` are not touched.
  std::vector<Face> collapse(const SimplifyGoal& goal, const std::vector<bool>& kept) const {
    std::vector<Face> faces;
    std::vector<unsigned int> indices;
    indices.reserve(3 * mesh_.faces.size());
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      if (kept[f])
        faces.push_back(mesh_.faces[f]);
      else
        indices.insert(indices.end(), mesh_.faces[f].v, mesh_.faces[f].v + 3);
    }
    const std::size_t target = goal.triangles > faces.size() ? goal.triangles - faces.size() : 0;
    constexpr double kAnyError = 1e3;  // relative to the mesh's size
    const auto error = static_cast<float>(std::min(goal.error / size_, kAnyError));
    const unsigned int flags = faces.empty() ? 0 : static_cast<unsigned int>(meshopt_SimplifyLockBorder);
    std::vector<unsigned int> result(indices.size());
    result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), positions_.data(),
                                   mesh_.vertices.size(), 3 * sizeof(float), 3 * target, error, flags, nullptr));
    for (std::size_t i = 0; i < result.size(); i += 3) faces.push_back({{result[i], result[i + 1], result[i + 2]}});
    return faces;
  }

 private:
  const TriangleMesh& mesh_;
  double size_ = 1;
  std::vector<float> positions_;
};

/// The vertices where faces that came from a closed surface are not one: of edges that two faces run through the same
/// way, and of degenerate faces. Ascending, each once.
std::vector<std::uint32_t> faulty_vertices(const std::vector<Vec3>& vertices, const std::vector<Face>& faces) {
  std::vector<std::uint32_t> faulty;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Face& f : faces) {
    for (int k = 0; k < 3; ++k) edges.emplace_back(f.v[k], f.v[(k + 1) % 3]);
    const Triangle t{{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}};
    if (normal_unscaled(t) == Vec3{}) faulty.insert(faulty.end(), f.v, f.v + 3);
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i] == edges[i - 1]) faulty.insert(faulty.end(), {edges[i].first, edges[i].second});
  std::sort(faulty.begin(), faulty.end());
  faulty.erase(std::unique(faulty.begin(), faulty.end()), faulty.end());
  return faulty;
}

/// True where the mesh is closed, consistently oriented, without degenerate triangles, and has more than that volume.
bool is_solid(const CleanedMesh& cleaned, double least_volume) {
  return !cleaned.mesh.faces.empty() && cleaned.faults.closed() && cleaned.faults.degenerate_faces == 0 &&
         signed_volume(cleaned.mesh) > least_volume;
}

/// Collapses, and again with the surroundings of faults kept as they were, until there are none; empty where that does
/// not come to an end or not to a solid.
TriangleMesh collapse_solid(const CollapseInput& input, const SimplifyGoal& goal, double least_volume) {
  const TriangleMesh& mesh = input.mesh();
  std::vector<bool> kept(mesh.faces.size(), false), keep_around(mesh.vertices.size(), false);
  for (int round = 0; round < kRepairRounds; ++round) {
    TriangleMesh result{mesh.vertices, input.collapse(goal, kept)};
    const std::vector<std::uint32_t> faulty = faulty_vertices(result.vertices, result.faces);
    if (faulty.empty()) {
      CleanedMesh cleaned = clean_mesh(result);
      return is_solid(cleaned, least_volume) ? std::move(cleaned.mesh) : TriangleMesh{};
    }
    for (const std::uint32_t v : faulty) keep_around[v] = true;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (const std::uint32_t v : mesh.faces[f].v) kept[f] = kept[f] || keep_around[v];
  }
  return {};
}

}  // namespace

TriangleMesh simplify_mesh(const TriangleMesh& mesh, const SimplifyGoal& goal) {
  if (mesh.faces.size() <= goal.triangles) return mesh;
  const CollapseInput input(mesh);
  if (!is_solid(clean_mesh(mesh), 0)) {
    const std::vector<bool> none_kept(mesh.faces.size(), false);
    TriangleMesh result = clean_mesh({mesh.vertices, input.collapse(goal, none_kept)}).mesh;
    return result.faces.empty() ? mesh : result;
  }

  const double least_volume = kLeastVolume * signed_volume(mesh);
  const auto excess = static_cast<double>(mesh.faces.size() - goal.triangles);
  for (const double back : kBackOff) {
    const auto target = goal.triangles + static_cast<std::size_t>(back * excess);
    TriangleMesh result = collapse_solid(input, {target, goal.error}, least_volume);
    if (!result.faces.empty()) return result;
  }
  return mesh;
}

std::size_t count_simplified(const TriangleMesh& mesh, double error) {
  const std::vector<bool> none_kept(mesh.faces.size(), false);
  return CollapseInput(mesh).collapse({0, error}, none_kept).size();
}

}  // namespace dismantle
