// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/cross_direction.h"
#include "dismantle/narrowphase/intersect_triangle_triangle.h"

namespace dismantle {

/// The penetration depth of two triangles.
struct Penetration {
  double depth = 0;  ///< Length of the shortest translation that separates them [mm]; 0 where apart or touching.
  Vec3 axis;         ///< Unit direction: translating `b` by depth * axis separates them; zero where depth is 0.
};

/// The error bound of a depth relative to the largest coordinate difference M of the six corners. An axis is off by at
/// most sqrt(3) kCrossDirectionError < 2^-41. Tilted so, the support of the Minkowski difference, whose points are at
/// most sqrt(3) M long, grows by less than 2^-40 M; taking both ends of an edge for the same loses less than 2^-39.2 M;
/// the roundings of the projections are below 2^-49 M. That is half of the constant; the other half is margin.
inline constexpr double kPenetrationRelativeError = 0x1p-38;

namespace detail {

/// A projection on an axis.
struct Interval {
  double lower = 0;  ///< Smallest coordinate.
  double upper = 0;  ///< Largest coordinate.
};

/// The interval of two coordinates.
DISMANTLE_HOST_DEVICE inline Interval interval_of(double p, double q) {
  return p < q ? Interval{p, q} : Interval{q, p};
}

/// The interval of three coordinates.
DISMANTLE_HOST_DEVICE inline Interval interval_of(double p, double q, double r) {
  const Interval pq = interval_of(p, q);
  return {r < pq.lower ? r : pq.lower, r > pq.upper ? r : pq.upper};
}

/// The smallest overlap found, over axes of any length.
struct MinOverlap {
  double depth_squared = -1;  ///< Squared overlap; negative before the first axis.
  Vec3 axis;                  ///< The direction in which `b` has to move, of any length.

  /// Considers the projections of both triangles on `n`; false where they do not overlap: the triangles are apart or
  /// touch.
  DISMANTLE_HOST_DEVICE bool consider(Vec3 n, Interval a, Interval b) {
    const double forward = a.upper - b.lower, backward = b.upper - a.lower;
    const double overlap = forward < backward ? forward : backward;
    if (overlap <= 0) return false;
    const double squared = overlap / length_squared(n) * overlap;
    if (depth_squared >= 0 && squared >= depth_squared) return true;
    depth_squared = squared;
    axis = forward < backward ? n : -n;
    return true;
  }
};

/// Both triangles about a local origin, and their original corners.
struct LocalPair {
  ///@{ The original corners.
  const Triangle& a;
  const Triangle& b;
  ///@}
  ///@{ The corners about the local origin.
  Triangle local_a, local_b;
  ///@}
};

/// True for the zero vector.
DISMANTLE_HOST_DEVICE inline bool is_zero(Vec3 v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}

/// Considers the two face normals; false where one separates.
DISMANTLE_HOST_DEVICE inline bool consider_faces(MinOverlap& smallest, const LocalPair& pair) {
  const Triangle& a = pair.local_a;
  const Triangle& b = pair.local_b;
  const Vec3 normal_b = cross_direction(pair.b[0], pair.b[1], pair.b[0], pair.b[2]);
  if (!is_zero(normal_b)) {
    const double plane = dot(normal_b, b[0]);
    const Interval of_a = interval_of(dot(normal_b, a[0]), dot(normal_b, a[1]), dot(normal_b, a[2]));
    if (!smallest.consider(normal_b, of_a, {plane, plane})) return false;
  }
  const Vec3 normal_a = cross_direction(pair.a[0], pair.a[1], pair.a[0], pair.a[2]);
  if (is_zero(normal_a)) return true;
  const double plane = dot(normal_a, a[0]);
  const Interval of_b = interval_of(dot(normal_a, b[0]), dot(normal_a, b[1]), dot(normal_a, b[2]));
  return smallest.consider(normal_a, {plane, plane}, of_b);
}

/// Considers the nine cross products of edges; false where one separates.
DISMANTLE_HOST_DEVICE inline bool consider_edges(MinOverlap& smallest, const LocalPair& pair) {
  const Triangle& a = pair.local_a;
  const Triangle& b = pair.local_b;
  for (int i = 0; i < 3; ++i) {
    const int i_end = (i + 1) % 3, i_opposite = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j_end = (j + 1) % 3, j_opposite = (j + 2) % 3;
      const Vec3 n = cross_direction(pair.a[i], pair.a[i_end], pair.b[j], pair.b[j_end]);
      if (is_zero(n)) continue;
      const Interval of_a = interval_of(dot(n, a[i]), dot(n, a[i_opposite]));
      const Interval of_b = interval_of(dot(n, b[j]), dot(n, b[j_opposite]));
      if (!smallest.consider(n, of_a, of_b)) return false;
    }
  }
  return true;
}

}  // namespace detail

/// The depth of two triangles: the distance from the origin to the boundary of their Minkowski difference, over its 11
/// facet normals (2 face normals, 9 edge cross products); coplanar triangles have depth 0. With M the largest
/// coordinate difference (@pre 1e-140 to 1e140):
///   1. depth is within kPenetrationRelativeError * M of the exact value, for slivers and nearly parallel edges too.
///   2. depth is 0 where the triangles do not intersect, and where they are coplanar.
///   3. A triangle without area is the segment or point that it is: a segment through a face has a depth, two segments
///      have none.
DISMANTLE_HOST_DEVICE inline Penetration penetration_triangle_triangle(const Triangle& a, const Triangle& b) {
  const Vec3 origin = a[0];
  const detail::LocalPair pair{
      a, b, {{Vec3{}, a[1] - origin, a[2] - origin}}, {{b[0] - origin, b[1] - origin, b[2] - origin}}};
  detail::MinOverlap smallest;
  if (!detail::consider_faces(smallest, pair) || !detail::consider_edges(smallest, pair)) return {};
  if (smallest.depth_squared <= 0) return {};

  using std::sqrt;
  const Vec3 axis = smallest.axis / max_abs(smallest.axis);
  const Penetration found{sqrt(smallest.depth_squared), axis / length(axis)};
  double size = 0;
  for (int i = 0; i < 3; ++i) {
    const double of_a = max_abs(pair.local_a[i]), of_b = max_abs(pair.local_b[i]);
    size = max(size, max(of_a, of_b));
  }
  // `size` is at least M / 2, so that the depth of triangles that do not overlap stays below this.
  if (found.depth <= kPenetrationRelativeError * size &&
      relation_triangle_triangle(a, b) != TriangleRelation::Crossing) {
    return {};
  }
  return found;
}

}  // namespace dismantle
