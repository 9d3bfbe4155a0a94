// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/triangle_mesh.h"

#include "dismantle/geometry/adjacency.h"

#include <cstring>
#include <unordered_map>

namespace dismantle {

namespace {

struct PositionHash {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t h = 1469598103934665603ull;
    for (const double c : {p.x, p.y, p.z}) {
      const double plain = c + 0.0;  // -0 becomes 0
      std::uint64_t bits = 0;
      std::memcpy(&bits, &plain, sizeof bits);
      h = (h ^ bits) * 0x9E3779B97F4A7C15ull;
      h ^= h >> 32;
    }
    return h;
  }
};

bool is_degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || normal_unscaled(t) == Vec3{};
}

}  // namespace

Aabb bounds(const TriangleMesh& mesh) {
  Aabb box;
  for (const Vec3& p : mesh.vertices) box.extend(p);
  return box;
}

double signed_volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  const Vec3 origin = mesh.vertices.front();
  double six_volumes = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    six_volumes += dot(t[0] - origin, cross(t[1] - origin, t[2] - origin));
  }
  return six_volumes / 6;
}

CleanedMesh clean_mesh(const TriangleMesh& mesh) {
  CleanedMesh result;
  std::unordered_map<Vec3, std::uint32_t, PositionHash> first_with_position;
  first_with_position.reserve(mesh.vertices.size());
  std::vector<std::uint32_t> representative(mesh.vertices.size());
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto [entry, is_new] = first_with_position.try_emplace(mesh.vertices[i], i);
    representative[i] = entry->second;
    result.faults.welded_vertices += is_new ? 0 : 1;
  }

  std::vector<std::uint32_t> new_index(mesh.vertices.size(), Id<VertexTag>::kInvalid);
  std::vector<bool> used(mesh.vertices.size(), false);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (is_degenerate(mesh.triangle(f))) {
      ++result.faults.degenerate_faces;
      continue;
    }
    Face face;
    for (int k = 0; k < 3; ++k) used[face.v[k] = representative[mesh.faces[f].v[k]]] = true;
    result.mesh.faces.push_back(face);
  }
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!used[i]) continue;
    new_index[i] = static_cast<std::uint32_t>(result.mesh.vertices.size());
    result.mesh.vertices.push_back(mesh.vertices[i]);
  }
  for (Face& face : result.mesh.faces)
    for (std::uint32_t& v : face.v) v = new_index[v];

  const EdgeFaults edges = edge_faults(result.mesh);
  result.faults.boundary_edges = edges.boundary;
  result.faults.nonmanifold_edges = edges.nonmanifold;
  result.faults.misoriented_edges = edges.misoriented;
  result.faults.open_edges = edges.open;
  result.faults.inside_out = edges.open == 0 && signed_volume(result.mesh) < 0;
  return result;
}

}  // namespace dismantle
