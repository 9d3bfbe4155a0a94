// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/adjacency.h"

#include "dismantle/geometry/half_edges.h"

#include <algorithm>
#include <cmath>

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

bool is_in(const Aabb& box, const Vec3& p) {
  return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z &&
         p.z <= box.upper.z;
}

/// A tree of boxes about pieces of rims, none longer than twice their average, so that the boxes of long ones are
/// tight.
class RimTree {
 public:
  /// @param width finds the rims within this of a point
  RimTree(Span<const Rim> rims, double width) : rims_(rims), width_(width), tests_left_(kTestsPerRim * rims.size()) {
    double whole = 0;
    for (const Rim& rim : rims) whole += length(rim.to - rim.from);
    const double longest = 2 * whole / static_cast<double>(rims.size());
    for (std::uint32_t i = 0; i < rims.size(); ++i) append_pieces(i, longest);
    build(0, pieces_.size());
  }

  /// True if a point lies within the width of another rim that runs against one.
  bool is_covered(const Rim& rim, const Vec3& p) {
    std::size_t pending[64] = {0}, count = 1;  // depth of a balanced tree
    while (count > 0) {
      const std::size_t index = pending[--count];
      const Node& node = nodes_[index];
      const std::size_t tests = node.right > 0 ? 1 : 1 + node.last - node.first;
      if (tests_left_ < tests) return false;
      tests_left_ -= tests;
      if (!is_in(node.box, p)) continue;
      if (node.right > 0) {
        pending[count++] = node.right;
        pending[count++] = index + 1;
        continue;
      }
      for (std::size_t i = node.first; i < node.last; ++i)
        if (covers(rims_[pieces_[i].rim], rim, p)) return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t kLeafSize = 4;
  /// Tests of boxes and pieces, on average. A torn mesh of 600,000 faces needs 130. What needs more is no solid, or
  /// made to take long: what is not found by then counts as open.
  static constexpr std::size_t kTestsPerRim = 300;

  struct Piece {
    Aabb box;
    std::uint32_t rim;
  };
  /// A node is followed by its first child.
  struct Node {
    Aabb box;
    std::size_t first, last;  // pieces
    std::size_t right;        // the second child; 0: a leaf
  };

  bool covers(const Rim& other, const Rim& rim, const Vec3& p) const {
    return dot(other.to - other.from, rim.to - rim.from) < 0 && distance_to_segment(p, other) <= width_;
  }

  void append_pieces(std::uint32_t rim, double longest) {
    const Vec3 from = rims_[rim].from, along = rims_[rim].to - from;
    const double pieces = length(along) / longest;  // not a number where lengths overflow or vanish
    const int count = pieces > 1 ? 1 + static_cast<int>(pieces) : 1;
    const double reach = width_ * (1 + 1e-6);  // beyond rounding
    for (int k = 0; k < count; ++k) {
      Aabb box;
      for (const int end : {k, k + 1}) box.extend(from + (static_cast<double>(end) / count) * along);
      pieces_.push_back({inflated(box, reach), rim});
    }
  }

  void build(std::size_t first, std::size_t last) {
    const std::size_t index = nodes_.size();
    nodes_.push_back({{}, first, last, 0});
    for (std::size_t i = first; i < last; ++i) nodes_[index].box.extend(pieces_[i].box);
    if (last - first <= kLeafSize) return;
    const Vec3 size = nodes_[index].box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middle = [axis](const Piece& piece) { return piece.box.center()[axis]; };
    const std::size_t half = (first + last) / 2;
    const auto at = [this](std::size_t i) { return pieces_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(half), at(last), [&](const Piece& a, const Piece& b) {
      return middle(a) != middle(b) ? middle(a) < middle(b) : a.rim < b.rim;
    });
    build(first, half);
    nodes_[index].right = nodes_.size();
    build(half, last);
  }

  Span<const Rim> rims_;
  double width_;
  std::size_t tests_left_;
  std::vector<Piece> pieces_;
  std::vector<Node> nodes_;
};

/// The number of rims that no others run along in the opposite direction.
std::size_t count_open(const std::vector<Rim>& rims, double width) {
  RimTree tree(rims, width);
  return static_cast<std::size_t>(std::count_if(rims.begin(), rims.end(), [&tree](const Rim& rim) {
    return !tree.is_covered(rim, rim.from) || !tree.is_covered(rim, 0.5 * (rim.from + rim.to)) ||
           !tree.is_covered(rim, rim.to);
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
  if (!rims.empty()) faults.open = count_open(rims, kCrackWidth * length(box.upper - box.lower));
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
