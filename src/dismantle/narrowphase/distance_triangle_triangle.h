// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/cross_direction.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/intersect_triangle_triangle.h"

namespace dismantle {

/// The distance and the closest points of two triangles.
struct TriangleDistance {
  double distance = 0;  ///< 0 where they intersect or touch [mm].
  Vec3 point_a;         ///< On the first triangle [mm].
  Vec3 point_b;         ///< On the second triangle [mm].
};

/// The error bound of a distance relative to the largest coordinate difference M of the six corners. Only points of the
/// triangles are considered, so that a distance is never too small by more than rounding. It is too large by the error
/// of the closest points: for edges at an angle of sine s >= 2^-8 these are off by less than 32u M / s^2 along the
/// edges, which adds less than 32u M / s = 2^-40 M to the distance; for more nearly parallel ones the crossing is off
/// by sqrt(3) kCrossDirectionError M / s < 2^-41 M / s, which adds 2^-41 M; for faces the error is rounding of M alone.
inline constexpr double kDistanceRelativeError = 0x1p-38;

namespace detail {

/// Edges whose angle has a smaller squared sine than this are nearly parallel: the 2x2 system of their closest points
/// would lose more than half of its digits.
inline constexpr double kParallelSineSquared = 0x1p-16;

/// The nearest pair of points found.
struct NearestPair {
  double squared = -1;  ///< Squared distance; negative before the first pair.
  Vec3 point_a;         ///< On the first triangle.
  Vec3 point_b;         ///< On the second triangle.

  /// Keeps the pair where it is nearer.
  DISMANTLE_HOST_DEVICE void consider(Vec3 of_a, Vec3 of_b) {
    const double d = length_squared(of_b - of_a);
    if (squared >= 0 && d >= squared) return;
    squared = d;
    point_a = of_a;
    point_b = of_b;
  }
};

/// The nearest point to `p` of the segment from `from` to `from + along`.
DISMANTLE_HOST_DEVICE inline Vec3 nearest_on_segment(Vec3 p, Vec3 from, Vec3 along) {
  const double squared = length_squared(along);
  return squared > 0 ? from + clamped_to_unit(dot(p - from, along) / squared) * along : from;
}

/// Considers nearly parallel or zero-length edges: the four ends, and the crossing, whose position along the edges is
/// as uncertain as it matters little. All points considered are on the edges, so that no pair can be too near.
DISMANTLE_HOST_DEVICE inline void consider_parallel_edges(NearestPair& nearest, const Vec3 (&a)[2],
                                                          const Vec3 (&b)[2]) {
  const Vec3 along_a = a[1] - a[0], along_b = b[1] - b[0];
  for (int i = 0; i < 2; ++i) {
    nearest.consider(a[i], nearest_on_segment(a[i], b[0], along_b));
    nearest.consider(nearest_on_segment(b[i], a[0], along_a), b[i]);
  }
  const Vec3 n = cross_direction(a[0], a[1], b[0], b[1]);
  const Vec3 across_b = cross(along_b, n);  // The plane through edge b and n cuts edge a in the crossing.
  const double slope = dot(along_a, across_b);
  if (slope == 0) return;
  const Vec3 start = a[0] + clamped_to_unit(dot(b[0] - a[0], across_b) / slope) * along_a;
  const Vec3 on_b = nearest_on_segment(start, b[0], along_b);
  nearest.consider(nearest_on_segment(on_b, a[0], along_a), on_b);
}

/// Considers the closest points of two edges.
DISMANTLE_HOST_DEVICE inline void consider_edge_pair(NearestPair& nearest, const Vec3 (&a)[2], const Vec3 (&b)[2]) {
  const Vec3 along_a = a[1] - a[0], along_b = b[1] - b[0];
  const double aa = length_squared(along_a), bb = length_squared(along_b), ab = dot(along_a, along_b);
  if (aa * bb - ab * ab > kParallelSineSquared * (aa * bb)) {
    const ClosestPoints closest = closest_points_edge_edge(a, b);
    nearest.consider(closest.point_a, closest.point_b);
  } else {
    consider_parallel_edges(nearest, a, b);
  }
}

/// A triangle as its sections perpendicular to the longest edge. However thin it is, and without its normal, the
/// section at the position of a point along that edge contains the foot of the point, if the foot is in the triangle.
struct FaceSections {
  Vec3 from;                   ///< Begin of the longest edge.
  Vec3 to;                     ///< End of the longest edge.
  Vec3 apex;                   ///< The opposite corner.
  double apex_at = 0;          ///< Position of the apex along the edge, 0 to 1.
  double longest_squared = 0;  ///< Squared length of the edge.
};

/// The sections of a triangle.
DISMANTLE_HOST_DEVICE inline FaceSections face_sections(const Triangle& t) {
  FaceSections f;
  for (int i = 0; i < 3; ++i) {
    const Vec3 from = t[i], to = t[(i + 1) % 3];
    const double squared = length_squared(to - from);
    if (i > 0 && squared <= f.longest_squared) continue;
    f.from = from;
    f.to = to;
    f.apex = t[(i + 2) % 3];
    f.longest_squared = squared;
  }
  if (f.longest_squared > 0) f.apex_at = clamped_to_unit(dot(f.apex - f.from, f.to - f.from) / f.longest_squared);
  return f;
}

/// The foot of `p` on the face if it is in the face, else some point of the face.
DISMANTLE_HOST_DEVICE inline Vec3 foot_on_face(Vec3 p, const FaceSections& f) {
  if (!(f.longest_squared > 0)) return f.from;
  const Vec3 edge = f.to - f.from;
  const double at = clamped_to_unit(dot(p - f.from, edge) / f.longest_squared);
  const Vec3 lower = f.from + at * edge;
  const bool before = at < f.apex_at;
  const Vec3 end = before ? f.from : f.to;
  const double part = before ? at / f.apex_at : (f.apex_at < 1 ? (1 - at) / (1 - f.apex_at) : 1);
  return nearest_on_segment(p, lower, end + part * (f.apex - end) - lower);
}

/// Calls consider(point of the edge, nearest point of the face) for every edge of `edges` that crosses the plane of
/// `face`.
template <class Consider>
DISMANTLE_HOST_DEVICE void for_piercing(const Triangle& edges, const Triangle& face, const Consider& consider) {
  const Vec3 normal = cross_direction(face[0], face[1], face[0], face[2]);
  const FaceSections sections = face_sections(face);
  for (int i = 0; i < 3; ++i) {
    const Vec3 from = edges[i], to = edges[(i + 1) % 3];
    const double start = dot(normal, from - face[0]), end = dot(normal, to - face[0]);
    if ((start > 0) == (end > 0) || start == end) continue;
    const Vec3 through = from + clamped_to_unit(start / (start - end)) * (to - from);
    consider(through, foot_on_face(through, sections));
  }
}

/// Considers the corners of one triangle and the nearest points of the other one.
DISMANTLE_HOST_DEVICE inline void consider_corners(NearestPair& nearest, const Triangle& a, const Triangle& b) {
  const FaceSections face_a = face_sections(a), face_b = face_sections(b);
  for (int i = 0; i < 3; ++i) {
    nearest.consider(a[i], foot_on_face(a[i], face_b));
    nearest.consider(foot_on_face(b[i], face_a), b[i]);
  }
}

/// The nearest points of two triangles about a local origin.
DISMANTLE_HOST_DEVICE inline NearestPair nearest_points(const Triangle& a, const Triangle& b, bool intersecting) {
  NearestPair nearest;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) consider_edge_pair(nearest, {a[i], a[(i + 1) % 3]}, {b[j], b[(j + 1) % 3]});
  consider_corners(nearest, a, b);
  if (!intersecting) return nearest;
  for_piercing(a, b, [&nearest](Vec3 of_a, Vec3 of_b) { nearest.consider(of_a, of_b); });
  for_piercing(b, a, [&nearest](Vec3 of_b, Vec3 of_a) { nearest.consider(of_a, of_b); });
  return nearest;
}

}  // namespace detail

/// Distance and closest points of two triangles (6 vertex-face, 9 edge-edge, intersection). Robust for degenerate
/// input. With M the largest coordinate difference (@pre 1e-70 to 1e70):
///   1. distance is within kDistanceRelativeError * M of the exact one, and is 0 where the triangles intersect.
///   2. Each point is within kDistanceRelativeError * M, and the rounding of its coordinates, of its triangle, and the
///      points are `distance` apart within that; they are the same common point, within it, where they intersect.
DISMANTLE_HOST_DEVICE inline TriangleDistance distance_triangle_triangle(const Triangle& a, const Triangle& b) {
  const bool intersecting = intersect_triangle_triangle(a, b);
  const Vec3 origin = a[0];
  const detail::NearestPair nearest = detail::nearest_points(
      {{Vec3{}, a[1] - origin, a[2] - origin}}, {{b[0] - origin, b[1] - origin, b[2] - origin}}, intersecting);
  using std::sqrt;
  return {intersecting ? 0 : sqrt(nearest.squared), origin + nearest.point_a, origin + nearest.point_b};
}

/// True where distance_triangle_triangle() is no more than `limit`. Much faster where it is: mostly a corner is as
/// near.
DISMANTLE_HOST_DEVICE inline bool triangles_within(const Triangle& a, const Triangle& b, double limit) {
  const Vec3 origin = a[0];
  const Triangle local_a{{Vec3{}, a[1] - origin, a[2] - origin}};
  const Triangle local_b{{b[0] - origin, b[1] - origin, b[2] - origin}};
  detail::NearestPair nearest;
  using std::sqrt;
  const auto is_within = [&] { return sqrt(nearest.squared) <= limit; };
  detail::consider_corners(nearest, local_a, local_b);
  if (is_within()) return true;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      detail::consider_edge_pair(nearest, {local_a[i], local_a[(i + 1) % 3]}, {local_b[j], local_b[(j + 1) % 3]});
      if (is_within()) return true;
    }
  return limit >= 0 && intersect_triangle_triangle(a, b);
}

}  // namespace dismantle
