// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/solid/depth_search.h"
#include "dismantle/audit/solid/thin_walls.h"
#include "dismantle/core/span.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

namespace dismantle::audit {

/// A point of one surface that is followed in the frame of another.
struct FollowedPoint {
  Vec3 body;                  ///< Where it is in its body [mm].
  std::optional<Vec3> ghost;  ///< Its ghost [mm, frame of the surface]; none while all sides are free.
  /// It has been further from the surface than allowed; before that, both sides are free.
  bool has_been_clear = false;
};

/// Part of the diagonal of the smaller of two components that points of their surfaces are apart from each other.
inline constexpr double kFollowedSpacing = 1.0 / 32;
/// The largest distance of neighbouring points that are followed of two components [mm].
inline double followed_spacing(const SolidBody& a, const SolidBody& b) {
  return 2 * kFollowedSpacing * std::min(a.surface().node(0).radius, b.surface().node(0).radius);
}
/// Largest number of points of one component.
inline constexpr std::size_t kMaxFollowed = 4096;

/// The vertices of a surface and points on its faces no further apart than `spacing` [mm]; further, where that would be
/// more than kMaxFollowed.
std::vector<FollowedPoint> followed_points(const AuditBody& body, double spacing);

/// Calls visit(face, point) for points on the faces of a surface, its vertices aside, no further apart than `spacing`
/// [mm]; further, where that would be more than kMaxFollowed.
void visit_points_of_faces(const AuditBody& body, double spacing,
                           const std::function<void(std::uint32_t, Vec3)>& visit);

/// The place that another solid takes in a solid in the assembled state. Two solids that overlap are drawn without what
/// makes room for one in the other: where one would stay in one piece with such a hole, points in it are free.
class Hole {
 public:
  /// @param margin by which the hole is wider than the other solid [mm] @param finest parts that are thinner may be
  /// taken for connected [mm] @param known must outlive this
  Hole(const SolidBody& solid, const SolidBody& other, double margin, double finest, KnownWalls& known)
      : solid_(&solid), other_(&other), margin_(margin), finest_(finest), known_(&known) {}
  /// True if the solid has a hole, and a point [mm, its frame] is in it.
  bool has(Vec3 point) const;

 private:
  const SolidBody *solid_, *other_;
  double margin_, finest_;
  KnownWalls* known_;
};

/// The points of one component that are followed in the frame of another one, from move to move.
struct FollowedSide {
  std::vector<FollowedPoint> points;  ///< None where nothing is followed.
  std::optional<Hole> hole;           ///< Of solids that overlap in the assembled state.
  bool until_apart = false;           ///< Once the pair has been apart, its depth tells what passes through.
};

/// A point that went through a surface.
struct Crossing {
  double beyond = 0;          ///< How far it is behind its ghost [mm]; 0 for none.
  std::uint32_t segment = 0;  ///< Index of the segment.
  double s = 0;               ///< Time, in [0, 1] of the segment.
  Vec3 point;                 ///< Where it is [mm, frame of the surface].
};

/// The limits for points of one body, in the frame of the other body's surface.
struct CrossingRule {
  Span<const RelativeMotion> motions;  ///< Of the points relative to the surface, in each segment.
  Span<const double> allowed;          ///< Largest distance of a point from its ghost in each segment [mm].
  double slack = 0;                    ///< Violated where it is more than this above it [mm].
  double rounding = 0;                 ///< Error bound of a distance [mm].
  const Hole* hole = nullptr;          ///< Where points are free; null for none.
  std::uint32_t hole_until = 0;        ///< The segments before this one have the hole.
};

/// Follows points through a move and finds the first in time that goes through the surface. Each point is followed by a
/// ghost, which never crosses the surface and is always within the allowed distance; a point that has none any more has
/// crossed it. Ghosts start where points come within the allowed distance of the surface, on their side of it; points
/// that are within it from the start on may leave to either side.
Crossing follow_points(const AuditBody& surface, std::vector<FollowedPoint>& followed, const CrossingRule& rule);

/// True if the depth of a pair does not tell what passes through it: one component is a sheet, or thinner on average
/// than four tolerances.
bool needs_crossing_test(const SolidBody& a, const SolidBody& b, double tolerance);

}  // namespace dismantle::audit
