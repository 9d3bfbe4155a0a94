// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/intersect_flat.h"

namespace dismantle {

/// The relation of two closed triangles.
enum class TriangleRelation {
  Apart,     ///< No common point.
  Flat,      ///< A common point; coplanar, or one triangle has no area.
  Crossing,  ///< A common point; both have area, in different planes.
};

namespace detail {

/// The corner of a triangle that is alone on its side of another triangle's plane, or on the plane; the other two
/// corners are not on that side.
struct LoneCorner {
  int apex = 0;        ///< The corner.
  bool above = false;  ///< Its side is that of the plane's normal; a corner in the plane counts as either.
};

/// The lone corner by the sides of the corners. @pre the signs are neither all positive, all negative nor all zero
DISMANTLE_HOST_DEVICE inline LoneCorner lone_corner(const int (&side)[3]) {
  // A corner in the plane counts as below where another is above, else as above: then one or two are above.
  const bool any_above = (side[0] > 0) | (side[1] > 0) | (side[2] > 0);
  const int threshold = any_above ? 1 : 0;
  const bool up[3] = {side[0] >= threshold, side[1] >= threshold, side[2] >= threshold};
  const bool above = up[0] + up[1] + up[2] == 1;
  return {up[0] == above ? 0 : (up[1] == above ? 1 : 2), above};
}

/// A triangle's corners from `first` on, in its order or, if `reversed`, in the opposite one.
DISMANTLE_HOST_DEVICE inline Triangle rotated(const Triangle& t, int first, bool reversed) {
  const int next = first == 2 ? 0 : first + 1, last = first == 0 ? 2 : first - 1;
  return {{t[first], t[reversed ? last : next], t[reversed ? next : last]}};
}

/// Computes the sides of a triangle's corners; true if all are strictly on one side.
DISMANTLE_HOST_DEVICE inline bool on_one_side(const OrientedPlane& plane, const Triangle& t, int (&side)[3]) {
  for (int i = 0; i < 3; ++i) side[i] = side_of_plane(plane, t[i]);
  const int sum = side[0] + side[1] + side[2];
  return sum * sum == 9;
}

/// True if all corners are in the plane.
DISMANTLE_HOST_DEVICE inline bool all_zero(const int (&side)[3]) {
  return (side[0] | side[1] | side[2]) == 0;
}

}  // namespace detail

/// The relation of two triangles; exact, as intersect_triangle_triangle().
DISMANTLE_HOST_DEVICE inline TriangleRelation relation_triangle_triangle(const Triangle& a, const Triangle& b) {
  int side_a[3], side_b[3];
  if (detail::on_one_side(oriented_plane(b[0], b[1], b[2]), a, side_a)) return TriangleRelation::Apart;
  if (detail::on_one_side(oriented_plane(a[0], a[1], a[2]), b, side_b)) return TriangleRelation::Apart;
  if (detail::all_zero(side_a) || detail::all_zero(side_b))
    return detail::intersect_flat(a, b) ? TriangleRelation::Flat : TriangleRelation::Apart;

  // Both triangles meet the line of their planes, each in an interval between the two edges at its lone corner. Turned
  // so that each lone corner is above the other's plane, two signs compare the ends of the intervals.
  const detail::LoneCorner lone_a = detail::lone_corner(side_a), lone_b = detail::lone_corner(side_b);
  const Triangle p = detail::rotated(a, lone_a.apex, !lone_b.above);
  const Triangle q = detail::rotated(b, lone_b.apex, !lone_a.above);
  const bool meet = orient3d_sign(p[1], q[0], p[0], q[1]) <= 0 && orient3d_sign(p[0], q[0], p[2], q[2]) <= 0;
  return meet ? TriangleRelation::Crossing : TriangleRelation::Apart;
}

/// True if the closed triangles share a point (touching counts). Exact for every finite double input, degenerate
/// triangles included: Devillers and Guigue's orientation signs (INRIA RR-4488; Du et al. 2015, algorithm 2) with the
/// coplanar case, the signs by a floating-point filter and then by exact arithmetic.
DISMANTLE_HOST_DEVICE inline bool intersect_triangle_triangle(const Triangle& a, const Triangle& b) {
  return relation_triangle_triangle(a, b) != TriangleRelation::Apart;
}

}  // namespace dismantle
