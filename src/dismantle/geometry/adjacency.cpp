// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/adjacency.h"

#include "dismantle/geometry/half_edges.h"

#include <algorithm>

namespace dismantle {

namespace {

/// An edge at which the surface may end, in the direction that its faces run along it.
struct Rim {
  Vec3 from, to;
};

/// Largest distance between the two sides of a crack, relative to the mesh's diagonal: as rounded coordinates and
/// missing slivers leave it.
constexpr double kCrackWidth = 1e-4;
/// Rims that are compared, at most; all of more count as open.
constexpr std::size_t kMaxRims = 20000;

double distance_to_segment(Vec3 p, const Rim& rim) {
  const Vec3 along = rim.to - rim.from;
  const double t = std::clamp(dot(p - rim.from, along) / length_squared(along), 0.0, 1.0);
  return length(p - (rim.from + t * along));
}

/// The number of rims that no others run along in the opposite direction.
std::size_t count_open(std::vector<Rim> rims, double width) {
  if (rims.size() > kMaxRims) return rims.size();
  const auto lowest = [](const Rim& r) { return std::min(r.from.x, r.to.x); };
  const auto highest = [](const Rim& r) { return std::max(r.from.x, r.to.x); };
  std::sort(rims.begin(), rims.end(), [&](const Rim& a, const Rim& b) { return lowest(a) < lowest(b); });
  double longest = 0;
  for (const Rim& r : rims) longest = std::max(longest, highest(r) - lowest(r));
  const auto covered = [&](const Rim& rim, Vec3 p) {
    auto other = std::lower_bound(rims.begin(), rims.end(), p.x - longest - width,
                                  [&](const Rim& r, double x) { return lowest(r) < x; });
    for (; other != rims.end() && lowest(*other) <= p.x + width; ++other)
      if (dot(other->to - other->from, rim.to - rim.from) < 0 && distance_to_segment(p, *other) <= width) return true;
    return false;
  };
  return static_cast<std::size_t>(std::count_if(rims.begin(), rims.end(), [&](const Rim& rim) {
    return !covered(rim, rim.from) || !covered(rim, 0.5 * (rim.from + rim.to)) || !covered(rim, rim.to);
  }));
}

}  // namespace

EdgeFaults edge_faults(const TriangleMesh& mesh) {
  EdgeFaults faults;
  std::vector<Rim> rims;
  for_each_edge(sorted_half_edges(mesh.faces), [&](const HalfEdge* first, const HalfEdge* last) {
    const auto count = last - first;
    if (count == 1) ++faults.boundary;
    if (count > 2) ++faults.nonmanifold;
    if (count == 2 && first[0].forward == first[1].forward) ++faults.misoriented;
    const auto forward = std::count_if(first, last, [](const HalfEdge& e) { return e.forward; });
    if (2 * forward == count) return;
    const Vec3 low = mesh.vertices[first->low], high = mesh.vertices[first->high];
    rims.push_back(2 * forward > count ? Rim{low, high} : Rim{high, low});
  });
  const Aabb box = bounds(mesh);
  if (!rims.empty()) faults.open = count_open(std::move(rims), kCrackWidth * length(box.upper - box.lower));
  return faults;
}

std::vector<NeighbouringFaces> neighbouring_faces(Span<const Face> faces) {
  std::vector<NeighbouringFaces> neighbours;
  for_each_edge(sorted_half_edges(faces), [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first == 2) neighbours.push_back({{first[0].face, first[1].face}, {first->low, first->high}});
  });
  return neighbours;
}

std::vector<std::uint8_t> representative_features(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> features(mesh.faces.size(), 0);
  std::vector<bool> vertex_taken(mesh.vertices.size(), false);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.faces[f].v[k];
      if (vertex_taken[v]) continue;
      vertex_taken[v] = true;
      features[f] |= static_cast<std::uint8_t>(1u << k);
    }
  }
  for_each_edge(sorted_half_edges(mesh.faces), [&](const HalfEdge* first, const HalfEdge*) {
    features[first->face] |= static_cast<std::uint8_t>(8u << first->side);
  });
  return features;
}

}  // namespace dismantle
