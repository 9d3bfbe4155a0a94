// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/overlap_retraction.h"

#include "dismantle/features/axis_frame.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/ghost_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

namespace dismantle {

namespace {

/// Depths below this share of the tolerance do not count as an overlap.
constexpr double kNoticeable = 0.1;
/// Parts of triangles are divided until they add less than this share of the tolerance to what is needed.
constexpr double kFineness = 0.25;
/// At most so many parts of each surface are looked at.
constexpr std::size_t kMaxParts = 20000;
/// A face is retracted for a point whose nearest way out is no further than 45 degrees from it.
constexpr double kAlong = 0.7;
/// Retractions are at most this multiple of the depth.
constexpr double kMaxOfDepth = 1.5;
/// Facets of cylinders have normals across the axis to within this sine.
constexpr double kAcross = 0.1;
/// Two axes are one if they are no further apart than so many tolerances where the components meet, and their
/// directions differ by no more than this sine.
constexpr double kSameAxis = 1, kSameDirection = 1e-4;
/// The corners of a facet of a cylinder are this nearly on one circle, and its middle is no nearer to the axis than this
/// share of the radius.
constexpr double kOnCircle = 0.999, kSmallestFacet = 0.7;

class Retraction {
 public:
  Retraction(const OverlapSide& own, const OverlapSide& other, double depth, double tolerance)
      : own_(own), other_(other), depth_(depth), tolerance_(tolerance), needed_(own.tree->faces.size()) {
    normals_.reserve(needed_.size());
    for (std::uint32_t f = 0; f < needed_.size(); ++f)
      normals_.push_back((own.tree->inside_out ? -1.0 : 1.0) * normalized(normal_unscaled(own.tree->triangle(f))));
  }

  OverlapRetraction find() {
    find_patches();
    if (depth_ > kNoticeable * tolerance_) {
      look_inside(*own_.tree, other_, true);
      look_inside(*other_.tree, own_, false);
    }
    allow_turning();
    for (std::uint32_t f = 0; f < needed_.size(); ++f) needed_[root(f)] = std::max(needed_[root(f)], needed_[f]);
    for (std::uint32_t f = 0; f < needed_.size(); ++f) needed_[f] = needed_[root(f)];
    return {std::move(needed_), turning_};
  }

 private:
  /// A part of a face, and the largest depth that it may have.
  struct Part {
    double bound = 0;
    Triangle corners;
    std::uint32_t face = 0;
  };
  struct Shallower {
    bool operator()(const Part& a, const Part& b) const { return a.bound < b.bound; }
  };

  /// Looks for points of a surface inside a component, the possibly deepest first.
  void look_inside(const SolidTree& tree, const OverlapSide& inside, bool of_own) {
    std::priority_queue<Part, std::vector<Part>, Shallower> parts;
    for (std::uint32_t f = 0; f < tree.faces.size(); ++f) add({depth_, tree.triangle(f), f}, inside, of_own, parts);
    for (std::size_t seen = 0; !parts.empty() && seen < kMaxParts; ++seen) {
      const Part part = parts.top();
      parts.pop();
      const Triangle& t = part.corners;
      const int k = longest_edge(t);
      const Vec3 middle = (t[k] + t[(k + 1) % 3]) / 2;
      add({part.bound, {{t[k], middle, t[(k + 2) % 3]}}, part.face}, inside, of_own, parts);
      add({part.bound, {{middle, t[(k + 1) % 3], t[(k + 2) % 3]}}, part.face}, inside, of_own, parts);
    }
  }

  template <class Parts>
  void add(Part part, const OverlapSide& inside, bool of_own, Parts& parts) {
    const SurfaceTree& surface = inside.shape->surface();
    const Triangle& t = part.corners;
    const Vec3 center = (t[0] + t[1] + t[2]) / 3;
    const MeshDistance nearest = surface.distance(center);
    double radius = 0, from_face = 0;
    for (int i = 0; i < 3; ++i) {
      radius = std::max(radius, length(t[i] - center));
      from_face = std::max(from_face, surface.distance_to_face(t[i], nearest.face));
    }
    const bool is_inside = inside.shape->winding().inside(center);
    if (nearest.distance > radius && !is_inside) return;
    part.bound = std::min({part.bound, from_face, nearest.distance + radius});
    const double enough = kFineness * tolerance_;
    if (part.bound < enough) return;
    const std::uint32_t patch = root(of_own ? part.face : nearest.face);
    if (is_inside) need(part.face, center, nearest, of_own, inside);
    // Nothing of it needs more than the patch does already.
    if (part.bound > needed_[patch] + enough && radius > enough) parts.push(part);
  }

  void need(std::uint32_t face, Vec3 point, const MeshDistance& nearest, bool of_own, const OverlapSide& inside) {
    if (nearest.distance < kNoticeable * tolerance_) return;
    const Triangle& surface = inside.shape->surface().triangle(nearest.face);
    const Vec3 out = (closest_point_of_triangle(surface, point) - point) / nearest.distance;
    // A point of the other component has to get out of this one through its face, which is retracted past it.
    const std::uint32_t retracted = of_own ? face : nearest.face;
    const double along = (of_own ? -1 : 1) * dot(normals_[retracted], out);
    if (along < kAlong) return;
    double& needed = needed_[root(retracted)];
    needed = std::max(needed, std::min(nearest.distance / along, kMaxOfDepth * depth_));
  }

  static int longest_edge(const Triangle& t) {
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (length_squared(t[(i + 1) % 3] - t[i]) > length_squared(t[(longest + 1) % 3] - t[longest])) longest = i;
    return longest;
  }

  /// Retracts the facets of cylinders about a common axis until no corner of one meets the middle of the other's.
  void allow_turning() {
    if (std::getenv("GDBG2")) std::fprintf(stderr, "rev %d %d\n", own_.tree->revolution ? (int)own_.tree->revolution->axes().size() : -1, other_.tree->revolution ? (int)other_.tree->revolution->axes().size() : -1);
    if (!own_.tree->revolution || !other_.tree->revolution) return;
    if (std::getenv("GDBG2")) { for (auto& x : own_.tree->revolution->axes()) std::fprintf(stderr, "  axis %g %g %g dir %g %g %g turn %g\n", x.point.x, x.point.y, x.point.z, x.direction.x, x.direction.y, x.direction.z, x.turn); }
    for (const RevolutionAxis& mine : own_.tree->revolution->axes())
      for (const RevolutionAxis& theirs : other_.tree->revolution->axes())
        if (same(mine, theirs)) allow_turning(AxisFrame(mine.point, mine.direction));
  }

  bool same(const RevolutionAxis& a, const RevolutionAxis& b) const {
    const Vec3 off = b.point - a.point;
    return length(cross(a.direction, b.direction)) < kSameDirection &&
           length(off - dot(off, a.direction) * a.direction) < kSameAxis * tolerance_;
  }

  /// Facets of one cylinder in coordinates about its axis.
  struct Cylinder {
    std::vector<std::uint32_t> faces;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;  // from the axis [mm]
    double begin = nearest, end = -nearest;                                  // along the axis [mm]
  };
  /// By the radius in tolerances, negative for a bore.
  using Cylinders = std::map<double, Cylinder>;

  Cylinders cylinders_about(const AxisFrame& axis, const SolidTree& tree) const {
    Cylinders cylinders;
    for (std::uint32_t f = 0; f < tree.faces.size(); ++f) {
      const Triangle t = tree.triangle(f);
      const Vec3 normal = normalized(normal_unscaled(t));
      if (std::abs(dot(normal, axis.direction)) > kAcross) continue;
      const Vec3 across[3] = {axis.across(t[0]), axis.across(t[1]), axis.across(t[2])};
      const double r[3] = {length(across[0]), length(across[1]), length(across[2])};
      const double farthest = std::max({r[0], r[1], r[2]});
      double nearest = farthest;
      for (int i = 0; i < 3; ++i)
        nearest = std::min(nearest, AxisFrame::distance_of_segment(across[i], across[(i + 1) % 3]));
      if (std::min({r[0], r[1], r[2]}) < kOnCircle * farthest || nearest < kSmallestFacet * farthest) continue;
      const double radius = std::round(farthest / tolerance_);
      Cylinder& cylinder = cylinders[dot(normal, across[0]) > 0 ? radius : -radius];
      cylinder.faces.push_back(f);
      cylinder.nearest = std::min(cylinder.nearest, nearest);
      cylinder.farthest = std::max(cylinder.farthest, farthest);
      for (int i = 0; i < 3; ++i) {
        cylinder.begin = std::min(cylinder.begin, axis.along(t[i]));
        cylinder.end = std::max(cylinder.end, axis.along(t[i]));
      }
    }
    return cylinders;
  }

  void allow_turning(const AxisFrame& axis) {
    const Cylinders mine = cylinders_about(axis, *own_.tree), theirs = cylinders_about(axis, *other_.tree);
    for (const auto& [mine_radius, f] : mine)
      for (const auto& [their_radius, g] : theirs) {
        if (mine_radius * their_radius > 0 || f.end < g.begin || g.end < f.begin) continue;
        const Cylinder &shaft = mine_radius > 0 ? f : g, &bore = mine_radius > 0 ? g : f;
        const double overlap = shaft.farthest - bore.nearest;
        if (std::getenv("GDBG2")) std::fprintf(stderr, "  coaxial %g %g: overlap %g\n", mine_radius, their_radius, overlap);
        const double sagittas = (shaft.farthest - shaft.nearest) + (bore.farthest - bore.nearest);
        if (overlap <= 0 || overlap > depth_ + sagittas + tolerance_) continue;
        turning_ = std::max(turning_, overlap);
        for (const std::uint32_t face : f.faces) needed_[face] = std::max(needed_[face], overlap);
      }
  }

  std::uint32_t root(std::uint32_t face) {
    while (patch_[face] != face) face = patch_[face] = patch_[patch_[face]];
    return face;
  }

  void find_patches() {
    const std::vector<std::uint32_t> first = first_at_position(own_.tree->vertices);
    patch_.resize(needed_.size());
    std::iota(patch_.begin(), patch_.end(), 0u);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> at_edge;
    for (std::uint32_t f = 0; f < needed_.size(); ++f)
      for (int i = 0; i < 3; ++i) {
        const Face& face = own_.tree->faces[f];
        const std::pair edge = std::minmax(first[face.v[i]], first[face.v[(i + 1) % 3]]);
        const auto [known, is_new] = at_edge.try_emplace(edge, f);
        if (is_new || dot(normals_[f], normals_[known->second]) < std::cos(kSmoothAngle)) continue;
        patch_[root(f)] = root(known->second);
      }
  }

  const OverlapSide& own_;
  const OverlapSide& other_;
  double depth_, tolerance_;
  double turning_ = 0;
  std::vector<double> needed_;
  std::vector<Vec3> normals_;
  std::vector<std::uint32_t> patch_;  // a face of the same patch, or itself
};

}  // namespace

OverlapRetraction overlap_retraction(const OverlapSide& own, const OverlapSide& other, double depth, double tolerance) {
  return Retraction(own, other, depth, tolerance).find();
}

}  // namespace dismantle
