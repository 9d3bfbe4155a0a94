// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/overlap_retraction.h"

#include "dismantle/features/axis_frame.h"
#include "dismantle/math/angle.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/ghost_surface.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace dismantle {

namespace {

/// Depths below this share of the tolerance do not count as an overlap.
constexpr double kNoticeable = 0.1;
/// A face is retracted for a point whose nearest way out is no further than 45 degrees from it.
constexpr double kAlong = 0.7;
/// Facets of cylinders have normals across the axis to within this sine.
constexpr double kAcross = 0.1;
/// Two axes are one if they are no further apart than so many tolerances where the components meet, and their
/// directions differ by no more than this sine.
constexpr double kSameAxis = 1, kSameDirection = 1e-4;
/// Two corners of a facet of a cylinder, the third of which may be on a chord, are this nearly on one circle, and it is
/// no nearer to the axis than this share of the radius.
constexpr double kOnCircle = 0.999, kSmallestFacet = 0.965;

/// Facets count as a cylinder if they cover at least this share of a circle, which is divided into so many parts: the
/// ends of a thin plate lie on a circle, too.
constexpr double kShareOfCircle = 0.3;
constexpr std::size_t kParts = 72;

class Retraction {
 public:
  Retraction(const OverlapSide& own, const OverlapSide& other, double depth, double tolerance)
      : own_(own), other_(other), depth_(depth), tolerance_(tolerance), needed_(own.tree->faces.size()) {}

  double find_turning() {
    allow_turning();
    return turning_;
  }

  OverlapRetraction find() {
    for (std::uint32_t f = 0; f < needed_.size(); ++f)
      normals_.push_back((own_.tree->inside_out ? -1.0 : 1.0) * normalized(normal_unscaled(own_.tree->triangle(f))));
    find_patches();
    if (depth_ > kNoticeable * tolerance_) {
      look_at_samples(*own_.tree, other_, true);
      look_at_samples(*other_.tree, own_, false);
    }
    allow_turning();
    for (std::uint32_t f = 0; f < needed_.size(); ++f) needed_[root(f)] = std::max(needed_[root(f)], needed_[f]);
    for (std::uint32_t f = 0; f < needed_.size(); ++f) needed_[f] = needed_[root(f)];
    for (std::uint32_t f = 0; f < patch_.size(); ++f) patch_[f] = root(f);
    return {std::move(needed_), std::move(patch_), turning_};
  }

 private:
  /// Looks at the middles of the faces of a surface, and at the ends and middles of their edges in the component's box.
  void look_at_samples(const SolidTree& tree, const OverlapSide& inside, bool of_own) {
    const Aabb& box = inside.shape().surface().bounds();
    for (std::uint32_t f = 0; f < tree.faces.size(); ++f) {
      const Triangle t = tree.triangle(f);
      look_at((t[0] + t[1] + t[2]) / 3, f, inside, of_own);
      for (int i = 0; i < 3; ++i) {
        const Vec3 from = t[i], edge = t[(i + 1) % 3] - t[i];
        const auto [begin, end] = part_in_box(from, edge, box);
        if (begin > end) continue;
        for (const double at : {begin, (begin + end) / 2, end}) look_at(from + at * edge, f, inside, of_own);
      }
    }
  }

  /// The part of a segment in a box, as shares of it; empty if the first is larger.
  static std::pair<double, double> part_in_box(Vec3 from, Vec3 edge, const Aabb& box) {
    double begin = 0, end = 1;
    for (int k = 0; k < 3; ++k) {
      if (edge[k] == 0) {
        if (from[k] < box.lower[k] || from[k] > box.upper[k]) return {1, 0};
        continue;
      }
      const double a = (box.lower[k] - from[k]) / edge[k], b = (box.upper[k] - from[k]) / edge[k];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    return {begin, end};
  }

  void look_at(Vec3 point, std::uint32_t face, const OverlapSide& inside, bool of_own) {
    const SurfaceTree& surface = inside.shape().surface();
    Aabb at;
    at.extend(point);
    if (!overlaps(surface.bounds(), at)) return;
    const MeshDistance nearest = surface.distance(point, 0, depth_);
    if (nearest.distance <= needed_[root(of_own ? face : nearest.face)]) return;
    if (nearest.distance <= depth_ && inside.shape().winding().inside(point))
      need(face, point, nearest, of_own, inside);
  }

  void need(std::uint32_t face, Vec3 point, const MeshDistance& nearest, bool of_own, const OverlapSide& inside) {
    if (nearest.distance < kNoticeable * tolerance_) return;
    const Triangle& surface = inside.shape().surface().triangle(nearest.face);
    const Vec3 out = (closest_point_of_triangle(surface, point) - point) / nearest.distance;
    // A point of the other component has to get out of this one through its face, which is retracted past it.
    const std::uint32_t retracted = of_own ? face : nearest.face;
    const double along = (of_own ? -1 : 1) * dot(normals_[retracted], out);
    if (along < kAlong) return;
    double& needed = needed_[root(retracted)];
    needed = std::max(needed, nearest.distance / along);
  }

  /// Retracts the facets of cylinders about a common axis until no corner of one meets the middle of the other's.
  void allow_turning() {
    if (!own_.tree->revolution || !other_.tree->revolution) return;
    for (const RevolutionAxis& mine : own_.tree->revolution->axes())
      for (const RevolutionAxis& theirs : other_.tree->revolution->axes())
        if (same(mine, theirs)) allow_turning(AxisFrame(mine.point, mine.direction));
  }

  bool same(const RevolutionAxis& a, const RevolutionAxis& b) const {
    return same_axis(a, b, kSameDirection, kSameAxis * tolerance_);
  }

  /// A face in coordinates about an axis.
  struct Facet {
    Vec3 across[3];                    // of its corners
    double along[3];                   // of its corners [mm]
    double nearest = 0, farthest = 0;  // distances from the axis [mm]
    double on_circle = 0;              // that of the second farthest corner [mm]
    bool is_shaft = false;             // its normal points away from the axis

    Facet(const AxisFrame& axis, const Triangle& t, const Vec3& normal) {
      for (int i = 0; i < 3; ++i) {
        across[i] = axis.across(t[i]);
        along[i] = axis.along(t[i]);
      }
      double corners[] = {length(across[0]), length(across[1]), length(across[2])};
      std::sort(std::begin(corners), std::end(corners));
      on_circle = corners[1];
      nearest = farthest = corners[2];
      for (int i = 0; i < 3; ++i)
        nearest = std::min(nearest, AxisFrame::distance_of_segment(across[i], across[(i + 1) % 3]));
      is_shaft = dot(normal, across[0]) > 0;
    }
  };

  /// Facets of one cylinder in coordinates about its axis.
  struct Cylinder {
    std::vector<std::uint32_t> faces;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;  // from the axis [mm]
    double begin = nearest, end = -nearest;                                  // along the axis [mm]
    std::bitset<kParts> seen;                                                // of the circle

    bool is_round() const { return static_cast<double>(seen.count()) >= kShareOfCircle * kParts; }
    void add(const AxisFrame& axis, std::uint32_t face, const Facet& facet) {
      faces.push_back(face);
      for (int i = 0; i < 3; ++i) see(axis, facet.across[i], facet.across[(i + 1) % 3]);
      nearest = std::min(nearest, facet.nearest);
      farthest = std::max(farthest, facet.farthest);
      for (const double at : facet.along) {
        begin = std::min(begin, at);
        end = std::max(end, at);
      }
    }
    /// Adds the part of the circle between two points of it, the short way round.
    void see(const AxisFrame& axis, const Vec3& from, const Vec3& to) {
      constexpr int kSteps = 8;
      for (int i = 0; i <= kSteps; ++i) {
        const double share = static_cast<double>(i) / kSteps;
        const Vec3 p = (1 - share) * from + share * to;
        const double part = (axis.angle(p) / kTurn + 0.5) * kParts;
        seen.set(std::min(kParts - 1, static_cast<std::size_t>(std::max(0.0, part))));
      }
    }
  };
  /// By the radius in tolerances, negative for a bore.
  using Cylinders = std::map<double, Cylinder>;

  Cylinders cylinders_about(const AxisFrame& axis, const SolidTree& tree) const {
    Cylinders cylinders;
    std::vector<std::pair<std::uint32_t, Facet>> others;  // that may be parts of facets
    for (std::uint32_t f = 0; f < tree.faces.size(); ++f) {
      const Triangle t = tree.triangle(f);
      const Vec3 normal = normalized(normal_unscaled(t));
      if (std::abs(dot(normal, axis.direction)) > kAcross) continue;
      const Facet facet(axis, t, normal);
      if (facet.nearest < kSmallestFacet * facet.farthest) continue;
      if (facet.on_circle < kOnCircle * facet.farthest) {
        others.emplace_back(f, facet);
        continue;
      }
      const double radius = std::round(facet.farthest / tolerance_);
      cylinders[facet.is_shaft ? radius : -radius].add(axis, f, facet);
    }
    for (auto& [radius, cylinder] : cylinders) add_parts(axis, tree, others, radius > 0, cylinder);
    return cylinders;
  }

  /// Adds faces between the chords and the circle of a cylinder that share corners with its facets.
  static void add_parts(const AxisFrame& axis, const SolidTree& tree,
                        std::vector<std::pair<std::uint32_t, Facet>>& others, bool is_shaft, Cylinder& cylinder) {
    if (others.empty() || !cylinder.is_round()) return;
    std::set<std::uint32_t> corners;
    for (const std::uint32_t f : cylinder.faces) corners.insert(std::begin(tree.faces[f].v), std::end(tree.faces[f].v));
    for (bool more = true; more;) {
      more = false;
      for (auto& [f, facet] : others) {
        const auto& v = tree.faces[f].v;
        if (facet.is_shaft != is_shaft || facet.farthest > cylinder.farthest ||
            facet.nearest < kSmallestFacet * cylinder.farthest ||
            std::none_of(std::begin(v), std::end(v), [&](std::uint32_t corner) { return corners.count(corner) > 0; }))
          continue;
        cylinder.add(axis, f, facet);
        corners.insert(std::begin(v), std::end(v));
        facet.farthest = std::numeric_limits<double>::infinity();  // it is taken
        more = true;
      }
    }
  }

  void allow_turning(const AxisFrame& axis) {
    const Cylinders mine = cylinders_about(axis, *own_.tree), theirs = cylinders_about(axis, *other_.tree);
    for (const auto& [mine_radius, f] : mine)
      for (const auto& [their_radius, g] : theirs) {
        if (mine_radius * their_radius > 0 || f.end < g.begin || g.end < f.begin) continue;
        if (!f.is_round() || !g.is_round()) continue;
        const Cylinder &shaft = mine_radius > 0 ? f : g, &bore = mine_radius > 0 ? g : f;
        const double overlap = shaft.farthest - bore.nearest;
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

double turning_retraction(const OverlapSide& a, const OverlapSide& b, double depth, double tolerance) {
  return std::max(Retraction(a, b, depth, tolerance).find_turning(), Retraction(b, a, depth, tolerance).find_turning());
}

OverlapRetraction overlap_retraction(const OverlapSide& own, const OverlapSide& other, double depth, double tolerance) {
  return Retraction(own, other, depth, tolerance).find();
}

}  // namespace dismantle
