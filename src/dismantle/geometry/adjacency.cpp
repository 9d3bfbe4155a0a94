// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/adjacency.h"

#include "dismantle/geometry/half_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// An edge at which the surface may end, in the direction that its faces run along it.
struct Rim {
  Vec3 from, to;
};

/// Largest distance between the two sides of a crack, relative to the mesh's diagonal: as rounded coordinates and
/// missing slivers leave it.
constexpr double kCrackWidth = 1e-4;

double distance_to_segment(Vec3 p, const Rim& rim) {
  const Vec3 along = rim.to - rim.from;
  const double t = std::clamp(dot(p - rim.from, along) / length_squared(along), 0.0, 1.0);
  return length(p - (rim.from + t * along));
}

/// The cells of a grid that rims pass through or near.
class RimGrid {
 public:
  /// @param width finds the rims within this of a point
  RimGrid(Span<const Rim> rims, const Aabb& box, double width) : rims_(rims), lower_(box.lower), width_(width) {
    double whole = 0;
    for (const Rim& rim : rims) whole += length(rim.to - rim.from);
    cell_ = std::max(2 * whole / static_cast<double>(rims.size()), 2 * width);
    for (std::uint32_t i = 0; i < rims.size(); ++i) enter(i);
    std::sort(entries_.begin(), entries_.end());
    entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
  }

  /// True if a point lies within the width of another rim that runs against one.
  bool is_covered(const Rim& rim, const Vec3& p) const {
    const std::uint64_t cell = key(index(p.x - lower_.x), index(p.y - lower_.y), index(p.z - lower_.z));
    auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{cell, 0});
    for (; entry != entries_.end() && entry->first == cell; ++entry) {
      const Rim& other = rims_[entry->second];
      if (dot(other.to - other.from, rim.to - rim.from) < 0 && distance_to_segment(p, other) <= width_) return true;
    }
    return false;
  }

 private:
  using Entry = std::pair<std::uint64_t, std::uint32_t>;  // cell, rim

  /// Cell along one axis. Cells are no smaller than a width, so that there are fewer than 2^20 of them.
  std::uint64_t index(double offset) const {
    return static_cast<std::uint64_t>(std::max(0.0, std::floor(offset / cell_)));
  }
  static std::uint64_t key(std::uint64_t x, std::uint64_t y, std::uint64_t z) { return x << 40 | y << 20 | z; }

  /// Enters a rim by pieces no longer than a cell.
  void enter(std::uint32_t rim) {
    const Vec3 from = rims_[rim].from, along = rims_[rim].to - from;
    const int pieces = 1 + static_cast<int>(length(along) / cell_);
    const double reach = width_ * (1 + 1e-6);  // beyond rounding
    for (int piece = 0; piece < pieces; ++piece) {
      Aabb box;
      box.extend(from + (static_cast<double>(piece) / pieces) * along - lower_);
      box.extend(from + (static_cast<double>(piece + 1) / pieces) * along - lower_);
      for (std::uint64_t x = index(box.lower.x - reach); x <= index(box.upper.x + reach); ++x)
        for (std::uint64_t y = index(box.lower.y - reach); y <= index(box.upper.y + reach); ++y)
          for (std::uint64_t z = index(box.lower.z - reach); z <= index(box.upper.z + reach); ++z)
            entries_.emplace_back(key(x, y, z), rim);
    }
  }

  Span<const Rim> rims_;
  Vec3 lower_;
  double width_, cell_ = 0;
  std::vector<Entry> entries_;
};

/// The number of rims that no others run along in the opposite direction.
std::size_t count_open(const std::vector<Rim>& rims, const Aabb& box, double width) {
  const RimGrid grid(rims, box, width);
  return static_cast<std::size_t>(std::count_if(rims.begin(), rims.end(), [&grid](const Rim& rim) {
    return !grid.is_covered(rim, rim.from) || !grid.is_covered(rim, 0.5 * (rim.from + rim.to)) ||
           !grid.is_covered(rim, rim.to);
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
  if (!rims.empty()) faults.open = count_open(rims, box, kCrackWidth * length(box.upper - box.lower));
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
