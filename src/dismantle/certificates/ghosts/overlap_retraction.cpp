// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/overlap_retraction.h"

#include "dismantle/narrowphase/closest_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace dismantle {

namespace {

/// Depths below this share of the tolerance do not count as an overlap.
constexpr double kNoticeable = 0.1;
/// A face is retracted for a point whose nearest way out is no further than 45 degrees from it.
constexpr double kAlong = 0.7;
/// Two faces press on each other where the cosine between one's normal and the opposite of the other's is at least
/// this.
constexpr double kFacing = 0.5;

std::vector<Vec3> outward_normals(const SolidTree& tree) {
  std::vector<Vec3> normals;
  normals.reserve(tree.faces.size());
  for (std::uint32_t f = 0; f < tree.faces.size(); ++f)
    normals.push_back((tree.inside_out ? -1.0 : 1.0) * normalized(normal_unscaled(tree.triangle(f))));
  return normals;
}

/// The retraction of one component's faces.
class Retraction {
 public:
  Retraction(const OverlapSide& own, const OverlapSide& other, const SurfaceEdges& edges, double depth,
             double tolerance)
      : solids_{&own, &other},
        depth_(depth),
        tolerance_(tolerance),
        needed_(own.tree->faces.size()),
        normals_(outward_normals(*own.tree)),
        normals_of_other_(outward_normals(*other.tree)) {
    find_patches(edges);
  }

  /// Looks at points of this component in the other one, or the other way round.
  void look_at(OverlapSamples& samples, bool of_own) {
    const SolidShape& solid = solids_[of_own ? 1 : 0]->shape();
    const Aabb& box = solid.surface().bounds();
    samples.for_each([&](std::uint32_t face, const OverlapSamples::Sample& sample) {
      Aabb at;
      at.extend(sample.point);
      if (!overlaps(box, at)) return;
      const MeshDistance nearest = samples.nearest(sample);
      if (nearest.distance <= needed_[root(of_own ? face : nearest.face)]) return;
      if (nearest.distance <= depth_ && samples.inside(sample)) need(face, sample.point, nearest, of_own, solid);
    });
  }

  OverlapRetraction result(const TurningRetraction& turning) {
    for (std::uint32_t f = 0; f < needed_.size(); ++f) add_need(f, std::max(needed_[f], turning.needed[f]));
    for (const Unopposed& point : unopposed_)
      if (!gets_out(point)) add_need(point.face, point.needed);
    for (std::uint32_t f = 0; f < needed_.size(); ++f) needed_[f] = needed_[root(f)];
    for (std::uint32_t f = 0; f < patch_.size(); ++f) patch_[f] = root(f);
    return {std::move(needed_), std::move(patch_), turning.largest};
  }

 private:
  void need(std::uint32_t face, Vec3 point, const MeshDistance& nearest, bool of_own, const SolidShape& solid) {
    if (nearest.distance < kNoticeable * tolerance_) return;
    const Triangle& surface = solid.surface().triangle(nearest.face);
    const Vec3 out = (closest_point_of_triangle(surface, point) - point) / nearest.distance;
    // A point of the other component has to get out of this one through its face, which is retracted past it.
    const std::uint32_t retracted = of_own ? face : nearest.face;
    const double along = (of_own ? -1 : 1) * dot(normals_[retracted], out);
    if (along < kAlong) return;
    const double needed = nearest.distance / along;
    if (of_own || -dot(normals_of_other_[face], normals_[retracted]) >= kFacing) {
      add_need(retracted, needed);
    } else {
      unopposed_.push_back({point, retracted, needed});
    }
  }

  void add_need(std::uint32_t face, double needed) { needed_[root(face)] = std::max(needed_[root(face)], needed); }

  /// A point of the other component whose nearest way out of this one is through a face that its own face does not
  /// press on: next to the rim of a bore, the face around it may be nearer than the wall.
  struct Unopposed {
    Vec3 point;          // [mm, assembled]
    std::uint32_t face;  // of this component
    double needed;       // its retraction [mm]
  };

  /// True if a point gets out through a face that is retracted for others.
  bool gets_out(const Unopposed& point) {
    const SurfaceTree& surface = solids_[0]->shape().surface();
    return !surface.for_each_near({&point.point, 1}, depth_, [&](std::uint32_t face) {
      const Vec3 way = closest_point_of_triangle(surface.triangle(face), point.point) - point.point;
      return dot(way, normals_[face]) < kAlong * length(way) || length(way) > needed_[root(face)];
    });
  }

  std::uint32_t root(std::uint32_t face) {
    while (patch_[face] != face) face = patch_[face] = patch_[patch_[face]];
    return face;
  }

  void find_patches(const SurfaceEdges& edges) {
    patch_.resize(needed_.size());
    std::iota(patch_.begin(), patch_.end(), 0u);
    for (std::uint32_t f = 0; f < needed_.size(); ++f)
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t edge = edges.edge[3 * f + i];
        if (edge == SurfaceEdges::kNoEdge) continue;
        const std::uint32_t other = edges.first_face[edge];
        if (other == f || dot(normals_[f], normals_[other]) < std::cos(kSmoothAngle)) continue;
        patch_[root(f)] = root(other);
      }
  }

  const OverlapSide* solids_[2];
  double depth_, tolerance_;
  std::vector<double> needed_;
  std::vector<Vec3> normals_, normals_of_other_;
  std::vector<Unopposed> unopposed_;
  std::vector<std::uint32_t> patch_;  // a face of the same patch, or itself
};

}  // namespace

PairOverlap::PairOverlap(const OverlapSide& a, const OverlapSide& b, double depth, double tolerance)
    : sides_{&a, &b}, depth_(depth), tolerance_(tolerance) {
  for (int k = 0; k < 2; ++k)
    turning_[k] = turning_retraction(*sides_[k]->tree, *sides_[1 - k]->tree, depth, tolerance);
}

double PairOverlap::turning() const {
  return std::max(turning_[0].largest, turning_[1].largest);
}

const OverlapRetraction& PairOverlap::retraction(bool of_a) {
  const int own = of_a ? 0 : 1;
  if (retractions_[own]) return *retractions_[own];
  for (int k = 0; k < 2; ++k)
    if (!edges_[k]) edges_[k].emplace(*sides_[k]->tree);
  Retraction retraction(*sides_[own], *sides_[1 - own], *edges_[own], depth_, tolerance_);
  if (depth_ > kNoticeable * tolerance_) {
    for (int k = 0; k < 2; ++k)
      if (!samples_[k]) samples_[k].emplace(*sides_[k]->tree, *edges_[k], *sides_[1 - k], depth_);
    retraction.look_at(*samples_[own], true);
    retraction.look_at(*samples_[1 - own], false);
  }
  return retractions_[own].emplace(retraction.result(turning_[own]));
}

}  // namespace dismantle
