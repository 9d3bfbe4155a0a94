// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/hausdorff_distance.h"

#include "dismantle/surface/depth/convex_polygon.h"
#include "dismantle/surface/surface_tree.h"

#include <algorithm>
#include <queue>
#include <vector>

namespace dismantle {

namespace {

/// A convex part of a triangle of one surface, and a bound of its points' distance from the other surface.
struct Piece {
  ConvexPolygon corners;
  double upper = 0;
  std::uint32_t face = 0;  // of the other surface, nearest to the centroid
};

struct FartherFirst {
  bool operator()(const Piece& a, const Piece& b) const { return a.upper < b.upper; }
};

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

  double bound_by_face(const ConvexPolygon& corners, std::uint32_t face) const {
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
  void push(ConvexPolygon corners, std::uint32_t nearby) {
    Piece piece{std::move(corners), 0, nearby};
    piece.upper = bound_by_face(piece.corners, nearby);
    if (piece.upper > goal()) {
      const Vec3 middle = centroid_of(piece.corners);
      const MeshDistance d = measure(middle, nearby);
      piece.face = d.face;
      piece.upper = std::min(
          {piece.upper, bound_by_face(piece.corners, d.face), d.distance + radius_about(piece.corners, middle)});
    }
    pieces_.push(std::move(piece));
  }

  void divide(const Piece& piece) {
    for (ConvexPolygon& part : divided(piece.corners, tree_.triangle(piece.face))) push(std::move(part), piece.face);
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
