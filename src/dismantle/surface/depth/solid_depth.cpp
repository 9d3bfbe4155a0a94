// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/solid_depth.h"

#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "dismantle/surface/depth/convex_polygon.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace dismantle {

namespace {

/// Polygons that more faces meet than these are halved, others are cut along one of the faces.
constexpr std::uint32_t kFewCutters = 24;

/// Winding numbers of meshes with holes cost as much as a piece more for so many edges of their rims.
constexpr std::size_t kRimEdgesPerPiece = 64;

/// The part of a surface that is searched for the point that is furthest from the other surface.
enum class Side { Inside, Outside };

/// One surface seen from the other's frame.
struct Facing {
  const SolidShape* own = nullptr;
  const SolidShape* other = nullptr;
  RigidTransform other_from_own;
};

/// A part of a surface: a node of its tree, or else a convex part of a triangle in the frame of the other component.
struct Piece {
  static constexpr std::uint32_t kMany = 0xffffffffu;  // value of `cutter`: many faces
  static constexpr std::uint32_t kNone = 0xfffffffeu;  // value of `cutter`: no face, as far as it matters

  double bound = 0;              // no point of it on the side wanted is further from the other surface [mm]
  bool of_b = false;             // of the surface of b
  NodeIndex node = kNoNode;      // kNoNode: a polygon
  std::uint32_t face = 0;        // of the other surface, near the middle
  std::uint32_t cutter = kNone;  // a face of the other surface that the polygon meets
  bool on_side = false;          // the polygon is on the side wanted as a whole
  ConvexPolygon corners;
};

struct FartherFirst {
  bool operator()(const Piece& a, const Piece& b) const { return a.bound < b.bound; }
};

struct Ball {
  Vec3 center;
  double radius = 0;
};

double distance(const Aabb& box, Vec3 p) {
  return length(max(max(box.lower - p, p - box.upper), Vec3{}));
}

/// Branch and bound for the point of surfaces that is on the side wanted of the other one and furthest from it.
class DepthSearch {
 public:
  DepthSearch(const PlacedShape& a, const PlacedShape& b, Side side, const DepthOptions& options)
      : side_(side), options_(options), world_from_a_(a.world_from_assembled), world_from_b_(b.world_from_assembled) {
    const RigidTransform b_from_a = inverse(world_from_b_) * world_from_a_;
    facing_[0] = {a.shape, b.shape, b_from_a};
    facing_[1] = {b.shape, a.shape, inverse(b_from_a)};
  }

  void start(bool of_b) {
    add_node({std::numeric_limits<double>::infinity(), of_b, kNoNode, 0, Piece::kNone, false, {}},
             facing_[of_b].own->surface().bvh().root());
  }

  /// Searches until the bounds are as near as asked for, or some point is further than `enough`.
  SolidDepth run(double enough) {
    while (!open_.empty() && open_.top().bound > goal() && best_.attained <= enough) {
      if (best_.pieces >= options_.pieces) {
        best_.capped = true;
        break;
      }
      const Piece worst = open_.top();
      open_.pop();
      divide(worst);
    }
    best_.depth = std::max(best_.attained, dropped_);
    if (!open_.empty()) best_.depth = std::max(best_.depth, open_.top().bound);
    return best_;
  }

 private:
  /// Pieces whose bound is at most this are not divided further [mm].
  double goal() const { return best_.attained + std::max(options_.gap, options_.relative_gap * best_.attained); }

  bool drop(double bound) {
    if (bound > goal()) return false;
    dropped_ = std::max(dropped_, bound);
    return true;
  }

  bool on_side(const SolidShape& other, Vec3 point) const {
    return other.winding().inside(point) == (side_ == Side::Inside);
  }

  /// True if no point of a ball that the surface does not meet is on the side wanted.
  bool elsewhere(const SolidShape& other, const Ball& ball) const {
    const WindingNumber& winding = other.winding();
    if (winding.closed()) return !on_side(other, ball.center);
    const double change = winding.max_change(ball.center, ball.radius);
    if (!(change < 1)) return false;
    const double at = std::abs(winding.at(ball.center));
    return side_ == Side::Inside ? at + change < 0.5 + kUndecidedWinding : at - change > 0.5 - kUndecidedWinding;
  }

  /// Takes a point on the side wanted into account.
  void attain(bool of_b, Vec3 point, double distance) {
    if (distance <= best_.attained) return;
    best_.attained = distance;
    best_.of_b = of_b;
    best_.deepest_at = (of_b ? world_from_a_ : world_from_b_) * point;
  }

  void add_node(const Piece& parent, NodeIndex node) {
    const Facing& facing = facing_[parent.of_b];
    const SurfaceTree& own = facing.own->surface();
    if (node < own.bvh().leaf_count()) {
      const Triangle& t = own.triangle(own.bvh().leaf_triangle[node]);
      const RigidTransform& m = facing.other_from_own;
      add_polygon(parent, {m * t[0], m * t[1], m * t[2]});
      return;
    }
    ++best_.pieces;
    const Ball ball{facing.other_from_own * own.center(node), diagonal(own.box(node)) / 2};
    const SurfaceTree& surface = facing.other->surface();
    if (side_ == Side::Inside && facing.other->winding().closed() &&
        distance(surface.bounds(), ball.center) > ball.radius)
      return;
    const MeshDistance d = surface.distance(ball.center, parent.face);
    const double bound = std::min(parent.bound, d.distance + ball.radius);
    if (drop(bound)) return;
    if (d.distance > ball.radius && elsewhere(*facing.other, ball)) return;
    open_.push({bound, parent.of_b, node, d.face, Piece::kNone, false, {}});
  }

  double bound_by_face(const SurfaceTree& surface, const ConvexPolygon& corners, std::uint32_t face) const {
    double farthest = 0;
    for (const Vec3& c : corners) farthest = std::max(farthest, surface.distance_to_face(c, face));
    return farthest;
  }

  void add_polygon(const Piece& parent, ConvexPolygon corners) {
    const SolidShape& other = *facing_[parent.of_b].other;
    const SurfaceTree& surface = other.surface();
    best_.pieces += 1 + other.winding().rim_edge_count() / kRimEdgesPerPiece;
    const double by_parent = std::min(parent.bound, bound_by_face(surface, corners, parent.face));
    if (drop(by_parent)) return;
    const Vec3 middle = centroid_of(corners);
    const Ball ball{middle, radius_about(corners, middle)};
    const MeshDistance d = surface.distance(middle, parent.face);
    const double bound = std::min({by_parent, bound_by_face(surface, corners, d.face), d.distance + ball.radius});
    if (drop(bound)) return;
    Piece piece{bound, parent.of_b, kNoNode, d.face, Piece::kNone, parent.on_side, std::move(corners)};
    if (!piece.on_side && !find_side(piece, ball, d)) return;
    try_point(piece, middle, d.distance);
    if (!drop(bound)) open_.push(std::move(piece));
  }

  /// Finds out whether a polygon is on one side as a whole, or else which face it meets. @return false where no point
  /// of it is on the side wanted and further from the surface than the slack
  bool find_side(Piece& piece, const Ball& ball, const MeshDistance& nearest) {
    const SolidShape& other = *facing_[piece.of_b].other;
    if (nearest.distance > ball.radius) {
      if (elsewhere(other, ball)) return false;
      if (off_holes(other, piece.corners, ball)) {
        drop(slack());
        return false;
      }
      piece.on_side = other.winding().closed();
      return true;
    }
    Vec3 shift;
    piece.cutter = cutter_of(piece, ball, nearest, shift);
    // So near to the surface, rounding hides the side of the middle, which speaks for the whole piece.
    const double from_shifted = other.surface().distance(ball.center + shift, nearest.face).distance;
    if (piece.cutter == Piece::kNone && from_shifted <= other.winding().placement()) piece.cutter = nearest.face;
    if (piece.cutter != Piece::kNone) return true;
    const Ball around{ball.center + shift, ball.radius + slack()};
    if (elsewhere(other, around) || off_fans(other, core_of(piece, ball), shift, around)) {
      drop(slack());
      return false;
    }
    piece.on_side = other.winding().closed();
    return true;
  }

  /// True if a polygon that does not meet the surface is outside a mesh with holes: when it is shifted by no more than
  /// the slack, it meets no fan either, and the holes cover too little of what can be seen from there.
  bool off_holes(const SolidShape& other, const ConvexPolygon& corners, const Ball& ball) const {
    if (other.winding().closed() || corners.size() < 3) return false;
    const Vec3 off = slack() / 2 * normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const Vec3 shift : {Vec3{}, off, -off})
      if (off_fans(other, corners, shift, {ball.center + shift, ball.radius})) return true;
    return false;
  }

  bool off_fans(const SolidShape& other, const ConvexPolygon& corners, Vec3 shift, const Ball& ball) const {
    const WindingNumber& winding = other.winding();
    if (winding.closed() || side_ != Side::Inside) return false;
    if (largest_met(*winding.fans(), corners, shift) != Piece::kNone) return false;
    return winding.bound_outside_fans(ball.center, ball.radius) < 0.5 + kUndecidedWinding;
  }

  /// The polygon without a rim.
  ConvexPolygon core_of(const Piece& piece, const Ball& ball) const {
    return scaled_about(piece.corners, ball.center, std::max(0.5, 1 - slack() / 2 / ball.radius));
  }

  /// A polygon stands for all points that are no further from it than this [mm]: half of what bounds may differ by.
  double slack() const { return options_.gap / 2; }

  /// The largest face that the polygon meets, kMany if it meets many, or kNone if it does not meet the surface once it
  /// is shrunk and shifted by no more than the slack: on its edges and on faces it may lie.
  std::uint32_t cutter_of(const Piece& piece, const Ball& ball, const MeshDistance& nearest, Vec3& shift) const {
    const SurfaceTree& surface = facing_[piece.of_b].other->surface();
    const double rim = slack() / 2;
    const ConvexPolygon core = core_of(piece, ball);
    if (nearest.distance <= slack()) {
      // It may lie on a face: off that face there may be nothing to meet.
      const Vec3 off = rim * normalized(normal_unscaled(surface.triangle(nearest.face)));
      for (const Vec3 by : {off, -off}) {
        if (largest_met(surface, core, by) != Piece::kNone) continue;
        shift = by;
        return Piece::kNone;
      }
    }
    shift = {};
    return largest_met(surface, core, {});
  }

  /// The largest face that a polygon meets when moved by `shift`; kMany if it meets many.
  std::uint32_t largest_met(const SurfaceTree& surface, ConvexPolygon polygon, Vec3 shift) const {
    for (Vec3& p : polygon) p += shift;
    std::uint32_t largest = Piece::kNone, count = 0;
    double area = -1;
    const bool few = surface.for_each_near(polygon, 0, [&](std::uint32_t face) {
      const Triangle& t = surface.triangle(face);
      if (!meets(polygon, t)) return true;
      if (++count > kFewCutters) return false;
      const double size = length_squared(normal_unscaled(t));
      if (size > area) {
        area = size;
        largest = face;
      }
      return true;
    });
    return few ? largest : Piece::kMany;
  }

  static bool meets(const ConvexPolygon& polygon, const Triangle& t) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      if (intersect_triangle_triangle({{polygon[0], polygon[i], polygon[i + 1]}}, t)) return true;
    return false;
  }

  /// @param second the face nearest to the farthest corner
  std::vector<ConvexPolygon> parts_of(const Piece& piece, const SurfaceTree& surface, std::uint32_t second) const {
    if (piece.cutter == Piece::kMany) return halved(piece.corners);
    if (piece.cutter != Piece::kNone) return divided_by_plane(piece.corners, surface.triangle(piece.cutter));
    if (second == piece.face) return divided(piece.corners, surface.triangle(piece.face));
    return divided_between(piece.corners, surface.triangle(piece.face), surface.triangle(second));
  }

  /// Takes a point of a piece into account.
  void try_point(const Piece& piece, Vec3 point, double distance) {
    if (distance <= best_.attained) return;
    const bool certain = piece.on_side && distance > slack();
    if (certain || on_side(*facing_[piece.of_b].other, point)) attain(piece.of_b, point, distance);
  }

  void divide(const Piece& piece) {
    const Facing& facing = facing_[piece.of_b];
    if (piece.node != kNoNode) {
      const Bvh& bvh = facing.own->surface().bvh();
      const BvhChildren children = bvh.children[piece.node - bvh.leaf_count()];
      add_node(piece, children.left);
      add_node(piece, children.right);
      return;
    }
    const SurfaceTree& surface = facing.other->surface();
    const Vec3 farthest = *std::max_element(piece.corners.begin(), piece.corners.end(), [&](Vec3 p, Vec3 q) {
      return surface.distance_to_face(p, piece.face) < surface.distance_to_face(q, piece.face);
    });
    const MeshDistance d = surface.distance(farthest, piece.face);
    try_point(piece, farthest, d.distance);
    if (drop(piece.bound)) return;
    for (ConvexPolygon& part : parts_of(piece, surface, d.face)) add_polygon(piece, std::move(part));
  }

  Side side_;
  DepthOptions options_;
  RigidTransform world_from_a_, world_from_b_;
  Facing facing_[2];  // of a, of b
  std::priority_queue<Piece, std::vector<Piece>, FartherFirst> open_;
  double dropped_ = 0;
  SolidDepth best_;
};

}  // namespace

SolidDepth solid_depth(const PlacedShape& a, const PlacedShape& b, const DepthOptions& options) {
  if (a.shape->empty() || b.shape->empty()) return {};
  DepthSearch search(a, b, Side::Inside, options);
  search.start(false);
  search.start(true);
  return search.run(std::numeric_limits<double>::infinity());
}

bool solid_contains(const PlacedShape& outer, const PlacedShape& inner, double tolerance, const DepthOptions& options) {
  if (outer.shape->empty() || inner.shape->empty()) return false;
  const auto at_most = [&](Side side, bool of_inner) {
    DepthSearch search(outer, inner, side, options);
    search.start(of_inner);
    const SolidDepth found = search.run(tolerance);
    return found.attained <= tolerance && !found.capped;
  };
  return at_most(Side::Outside, true) && at_most(Side::Inside, false);
}

}  // namespace dismantle
