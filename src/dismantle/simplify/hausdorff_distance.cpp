// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/hausdorff_distance.h"

#include "dismantle/simplify/surface_tree.h"

#include <algorithm>
#include <queue>
#include <vector>

namespace dismantle {

namespace {

using Polygon = std::vector<Vec3>;

/// A convex part of a triangle of one surface, and a bound of its points' distance from the other surface.
struct Piece {
  Polygon corners;
  double upper = 0;
  std::uint32_t face = 0;  // of the other surface, nearest to the centroid
};

struct FartherFirst {
  bool operator()(const Piece& a, const Piece& b) const { return a.upper < b.upper; }
};

// Smallest part of a piece's size that a cut has to separate.
constexpr double kMinCut = 1e-9;

/// The parts of a convex polygon on the two sides of a plane, and their extents from it.
struct CutPolygon {
  Polygon within, beyond;
  double reach_within = 0, reach_beyond = 0;

  bool proper(double size) const { return std::min(reach_within, reach_beyond) > kMinCut * size; }
};

/// @param normal unit length; `within` is dot(normal, x) <= offset
CutPolygon cut(const Polygon& polygon, Vec3 normal, double offset) {
  CutPolygon parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double beyond_a = dot(normal, a) - offset, beyond_b = dot(normal, b) - offset;
    parts.reach_within = std::max(parts.reach_within, -beyond_a);
    parts.reach_beyond = std::max(parts.reach_beyond, beyond_a);
    if (beyond_a <= 0) parts.within.push_back(a);
    if (beyond_a >= 0) parts.beyond.push_back(a);
    if (!((beyond_a < 0 && beyond_b > 0) || (beyond_a > 0 && beyond_b < 0))) continue;
    const Vec3 crossing = a + beyond_a / (beyond_a - beyond_b) * (b - a);
    parts.within.push_back(crossing);
    parts.beyond.push_back(crossing);
  }
  return parts;
}

Vec3 centroid_of(const Polygon& polygon) {
  Vec3 sum;
  for (const Vec3& p : polygon) sum += p;
  return sum / static_cast<double>(polygon.size());
}

/// Bounds the distance of one triangle's points.
class TriangleSearch {
 public:
  TriangleSearch(const SurfaceTree& tree, double lower, double absolute_gap, const HausdorffOptions& options)
      : tree_(tree), options_(options), absolute_gap_(absolute_gap), lower_(lower) {}

  DistanceBounds run(const Triangle& triangle, std::uint32_t nearby) {
    push({triangle[0], triangle[1], triangle[2]}, nearby);
    for (std::size_t count = 1; count < options_.pieces && pieces_.top().upper > goal(); ++count) {
      const Piece worst = pieces_.top();
      measure(farthest_corner(worst), worst.face);
      if (worst.upper <= goal()) break;  // the bound is reached
      pieces_.pop();
      divide(worst);
    }
    return {lower_, pieces_.top().upper};
  }

 private:
  /// The upper bound at which the search ends.
  double goal() const { return lower_ + std::max(absolute_gap_, options_.relative_gap * lower_); }

  MeshDistance measure(Vec3 point, std::uint32_t nearby) {
    const MeshDistance d = tree_.distance(point, nearby);
    lower_ = std::max(lower_, d.distance);
    return d;
  }

  double bound_by_face(const Polygon& corners, std::uint32_t face) const {
    double farthest = 0;
    for (const Vec3& c : corners) farthest = std::max(farthest, tree_.distance_to_face(c, face));
    return farthest;
  }

  Vec3 farthest_corner(const Piece& piece) const {
    return *std::max_element(piece.corners.begin(), piece.corners.end(), [&](Vec3 a, Vec3 b) {
      return tree_.distance_to_face(a, piece.face) < tree_.distance_to_face(b, piece.face);
    });
  }

  /// Adds a piece with its bound. @param nearby a triangle of the other surface that may be near
  void push(Polygon corners, std::uint32_t nearby) {
    if (corners.empty()) return;
    Piece piece{std::move(corners), 0, nearby};
    piece.upper = bound_by_face(piece.corners, nearby);
    if (piece.upper > goal()) {
      const Vec3 middle = centroid_of(piece.corners);
      const MeshDistance d = measure(middle, nearby);
      double radius = 0;
      for (const Vec3& c : piece.corners) radius = std::max(radius, length(c - middle));
      piece.face = d.face;
      piece.upper = std::min({piece.upper, bound_by_face(piece.corners, d.face), d.distance + radius});
    }
    pieces_.push(std::move(piece));
  }

  /// Cuts a piece along the sides of the triangle below its centroid, so that the part above that triangle is bounded
  /// tightly; through its centroid where that separates nothing.
  void divide(const Piece& piece) {
    const Triangle& below = tree_.triangle(piece.face);
    const Vec3 up = normal_unscaled(below);
    const Vec3 middle = centroid_of(piece.corners);
    const double size = length(farthest_from(middle, piece.corners) - middle);
    Polygon main = piece.corners;
    bool cut_off = false;
    for (int k = 0; k < 3; ++k) {
      const Vec3 outwards = normalized(cross(below[(k + 1) % 3] - below[k], up));
      const double offset = dot(outwards, below[k]);
      CutPolygon parts = cut(main, outwards, offset);
      if (!parts.proper(size)) continue;
      const bool middle_within = dot(outwards, middle) <= offset;
      main = std::move(middle_within ? parts.within : parts.beyond);
      push(std::move(middle_within ? parts.beyond : parts.within), piece.face);
      cut_off = true;
    }
    if (cut_off)
      push(std::move(main), piece.face);
    else
      halve(piece, middle);
  }

  static Vec3 farthest_from(Vec3 point, const Polygon& polygon) {
    return *std::max_element(polygon.begin(), polygon.end(),
                             [&](Vec3 a, Vec3 b) { return length_squared(a - point) < length_squared(b - point); });
  }

  void halve(const Piece& piece, Vec3 middle) {
    const Vec3 along = normalized(farthest_from(middle, piece.corners) - middle);
    CutPolygon parts = cut(piece.corners, along, dot(along, middle));
    push(std::move(parts.within), piece.face);
    push(std::move(parts.beyond), piece.face);
  }

  const SurfaceTree& tree_;
  const HausdorffOptions& options_;
  double absolute_gap_;
  double lower_;
  std::priority_queue<Piece, std::vector<Piece>, FartherFirst> pieces_;
};

}  // namespace

DistanceBounds one_sided_hausdorff_distance(const TriangleMesh& from, const TriangleMesh& to,
                                            const HausdorffOptions& options) {
  DISMANTLE_EXPECT(!from.faces.empty() && !to.faces.empty());
  Aabb box = bounds(from);
  box.extend(bounds(to));
  const SurfaceTree tree(to, options.executor);

  std::vector<MeshDistance> of_vertex(from.vertices.size());
  options.executor.for_each(of_vertex.size(), [&](std::size_t v) { of_vertex[v] = tree.distance(from.vertices[v]); });
  DistanceBounds result;
  for (const MeshDistance& d : of_vertex) result.lower = std::max(result.lower, d.distance);

  std::vector<DistanceBounds> of_face(from.faces.size());
  options.executor.for_each(of_face.size(), [&](std::size_t f) {
    TriangleSearch search(tree, result.lower, options.absolute_gap * diagonal(box), options);
    of_face[f] = search.run(from.triangle(f), of_vertex[from.faces[f].v[0]].face);
  });
  for (const DistanceBounds& b : of_face) {
    result.lower = std::max(result.lower, b.lower);
    result.upper = std::max(result.upper, b.upper);
  }
  result.upper += kHausdorffRounding * (max_abs(box.lower) + max_abs(box.upper));
  result.upper = std::max(result.upper, result.lower);
  return result;
}

DistanceBounds hausdorff_distance(const TriangleMesh& a, const TriangleMesh& b, const HausdorffOptions& options) {
  const DistanceBounds there = one_sided_hausdorff_distance(a, b, options);
  const DistanceBounds back = one_sided_hausdorff_distance(b, a, options);
  return {std::max(there.lower, back.lower), std::max(there.upper, back.upper)};
}

}  // namespace dismantle
