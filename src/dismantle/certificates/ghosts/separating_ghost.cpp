// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/separating_ghost.h"

#include "dismantle/certificates/sweep/triangle_pair_sweep_kernel.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/math/least_vector.h"
#include "dismantle/surface/ghost_surface.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// Rounds of finding faces that are not apart and displacing their corners.
constexpr int kRounds = 20;
/// It is given up after so many rounds in which no fewer faces were found than in one before.
constexpr int kStalledRounds = 5;
/// Faces count as apart at this share of the gap that is aimed at.
constexpr double kEnough = 0.5;
/// Faces count as touching up to this share of the gap, and axes as equally good: files round by as much as a hundredth
/// of it (coordinates in single precision).
constexpr double kTouching = 0.03;
/// Bound of the rounding of the length of a displacement, relative.
constexpr double kRounding = 1e-6;

class Displacing {
 public:
  explicit Displacing(const GhostRequest& request)
      : request_(request),
        first_(first_at_position(request.own->vertices)),
        bounds_(request.own->vertices.size()),
        has_start_(request.own->vertices.size()),
        is_new_(request.own->faces.size(), true),
        displaced_(request.start.begin(), request.start.end()) {}

  /// Adds the bounds of all pairs of faces that are not apart. @return the number of such pairs
  std::size_t add_bounds() {
    changed_.clear();
    std::size_t found = 0;
    for (const auto& [face_own, face_other] : request_.near)
      if (is_new_[face_own] && !boxes_are_apart(face_own, face_other)) found += add_bounds(face_own, face_other);
    return found;
  }

  /// Displaces the vertices whose bounds changed. @return false if one would have to go too far
  bool displace() {
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    for (const std::uint32_t v : changed_) {
      std::optional<Vec3> least = least_within_reach(v);
      if (!least && has_start_[v]) {
        // Where it starts is not what the faces need.
        bounds_[v].erase(bounds_[v].begin());
        has_start_[v] = false;
        least = least_within_reach(v);
      }
      if (!least) return false;
      displaced_[v] = request_.own->vertices[v] + *least;
    }
    std::vector<bool> is_changed(displaced_.size());
    for (const std::uint32_t v : changed_) is_changed[v] = true;
    for (std::size_t v = 0; v < displaced_.size(); ++v)
      if (is_changed[first_[v]]) displaced_[v] = displaced_[first_[v]];
    for (std::size_t f = 0; f < is_new_.size(); ++f) {
      const Face& face = request_.own->faces[f];
      is_new_[f] = is_changed[first_[face.v[0]]] || is_changed[first_[face.v[1]]] || is_changed[first_[face.v[2]]];
    }
    return true;
  }

  std::vector<Vec3> take() { return std::move(displaced_); }

 private:
  /// The shortest displacement of a vertex within its bounds, if it is not too long.
  std::optional<Vec3> least_within_reach(std::uint32_t v) const {
    const std::optional<Vec3> least = least_vector(bounds_[v]);
    return least && length(*least) <= (1 + kRounding) * request_.max_length ? least : std::nullopt;
  }

  Triangle displaced(std::uint32_t face) const {
    const Face& f = request_.own->faces[face];
    return {{displaced_[f.v[0]], displaced_[f.v[1]], displaced_[f.v[2]]}};
  }

  /// The axis from `own` to `other` along which two faces are to be kept apart: one that separates them as they are, or
  /// else the one along which they are furthest apart on the side that their normals tell. Of axes that are equally
  /// good that is a normal: where faces touch at an edge or a corner, rounding would choose any.
  Vec3 axis_of(std::uint32_t face_own, const Triangle& own, const Triangle& other) const {
    const Triangle plain = request_.own->triangle(face_own);
    const Vec3 separating = furthest_axis(plain, other, {});
    if (gap_along(separating, plain, other) > kTouching * request_.gap) return separating;
    detail::OutwardNormals normals;
    const bool neither = !request_.own->has_outside && !request_.other->has_outside;
    if (request_.own->has_outside || (neither && request_.own_is_oriented)) normals.a = normal_unscaled(plain);
    if (request_.other->has_outside || (neither && !request_.own_is_oriented)) normals.b = normal_unscaled(other);
    const Vec3 furthest = furthest_axis(own, other, normals);
    const double enough = gap_along(furthest, own, other) - kTouching * request_.gap;
    for (const Vec3& along : {normals.a, -normals.b})
      if (const Vec3 axis = normalized(along);
          length_squared(axis) > 0 && normals.allow(axis) && gap_along(axis, own, other) >= enough)
        return axis;
    return furthest;
  }

  static Vec3 furthest_axis(const Triangle& own, const Triangle& other, const detail::OutwardNormals& normals) {
    const TriangleMotion still{own, own};
    detail::LeastBlockingAxis search(still, other, normals, 1);  // of the largest gap
    search.consider_all(own);
    return search.axis();
  }

  /// The gap along an axis from `own` to `other` [mm].
  static double gap_along(Vec3 axis, const Triangle& own, const Triangle& other) {
    const double nearest = std::min({dot(axis, other[0]), dot(axis, other[1]), dot(axis, other[2])});
    return nearest - std::max({dot(axis, own[0]), dot(axis, own[1]), dot(axis, own[2])});
  }

  /// True if the boxes of two faces tell that they are apart.
  bool boxes_are_apart(std::uint32_t face_own, std::uint32_t face_other) const {
    Aabb box, other;
    for (const Vec3& p : displaced(face_own).corner) box.extend(p);
    for (const Vec3& p : request_.other->triangle(face_other).corner) other.extend(p);
    const Vec3 gap = max(other.lower - box.upper, box.lower - other.upper);
    return std::max({gap.x, gap.y, gap.z}) >= request_.gap;
  }

  /// @return true if the pair is not apart
  bool add_bounds(std::uint32_t face_own, std::uint32_t face_other) {
    const Triangle own = displaced(face_own), other = request_.other->triangle(face_other);
    const Vec3 axis = axis_of(face_own, own, other);
    if (length_squared(axis) == 0 || gap_along(axis, own, other) >= kEnough * request_.gap) return false;
    const double nearest = std::min({dot(axis, other[0]), dot(axis, other[1]), dot(axis, other[2])});
    const Triangle plain = request_.own->triangle(face_own);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = first_[request_.own->faces[face_own].v[i]];
      const double distance = request_.gap + dot(axis, plain[i]) - nearest;
      if (distance <= -request_.max_length) continue;
      // The displacement that the vertex starts with counts as a bound, too.
      if (bounds_[v].empty())
        if (const Vec3 before = displaced_[v] - request_.own->vertices[v]; length(before) > 0) {
          bounds_[v].push_back({before / length(before), length(before)});
          has_start_[v] = true;
        }
      bounds_[v].push_back({-axis, distance});
      changed_.push_back(v);
    }
    return true;
  }

  const GhostRequest& request_;
  std::vector<std::uint32_t> first_;
  std::vector<std::vector<VectorBound>> bounds_;  // of the first vertex at each position
  std::vector<bool> has_start_;  // for each vertex, if its first bound is the displacement it starts with
  std::vector<bool> is_new_;     // for each face: a corner was displaced since its pairs were last tested
  std::vector<Vec3> displaced_;
  std::vector<std::uint32_t> changed_;
};

}  // namespace

std::optional<std::vector<Vec3>> separating_ghost(const GhostRequest& request) {
  Displacing displacing(request);
  std::size_t fewest = request.near.size() + 1;
  for (int round = 0, stalled = 0; round < kRounds && stalled < kStalledRounds; ++round) {
    const std::size_t found = displacing.add_bounds();
    if (found == 0) return displacing.take();
    if (!displacing.displace()) return std::nullopt;
    stalled = found < fewest ? 0 : stalled + 1;
    fewest = std::min(fewest, found);
  }
  return std::nullopt;
}

}  // namespace dismantle
