// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

#include <limits>

namespace dismantle {

/// The closest points of two features, up to rounding. *Inexact*: good for an axis to try or a test with a tolerance,
/// never for a proof.
struct ClosestPoints {
  Vec3 point_a;           ///< On the first feature [mm].
  Vec3 point_b;           ///< On the second feature [mm].
  bool interior = false;  ///< Both points are in the interiors of their features.
};

/// The point itself (`point_a`) and the nearest point of the closed triangle (`point_b`). Zero-area triangles are taken
/// as the segment or point that they are (Ericson, Real-Time Collision Detection, 5.1.5). The fast one: on slivers it
/// may be off by more than rounding, where closest_point_of_triangle() is not.
DISMANTLE_HOST_DEVICE inline ClosestPoints closest_points_vertex_face(Vec3 p, const Triangle& face) {
  const Vec3 ab = face[1] - face[0], ac = face[2] - face[0], ap = p - face[0], bp = p - face[1], cp = p - face[2];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  const double along = d4 - d3, back = d5 - d6;

  // The weights of the second and third corner. A single return keeps them in registers.
  double weight_b = 0, weight_c = 0;
  bool interior = false;
  if (d1 <= 0 && d2 <= 0) {
  } else if (d3 >= 0 && d4 <= d3) {
    weight_b = 1;
  } else if (d6 >= 0 && d5 <= d6) {
    weight_c = 1;
  } else if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 - d3 > 0) {
    weight_b = d1 / (d1 - d3);
  } else if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 - d6 > 0) {
    weight_c = d2 / (d2 - d6);
  } else if (va <= 0 && along >= 0 && back >= 0 && along + back > 0) {
    weight_c = along / (along + back);
    weight_b = 1 - weight_c;
  } else if (va + vb + vc > 0) {
    const double area = va + vb + vc;
    weight_b = vb / area;
    weight_c = vc / area;
    interior = true;
  }
  return {p, face[0] + (weight_b * ab + weight_c * ac), interior};
}

namespace detail {

/// The nearest point of the segment a-b; exactly an end where that is the nearest.
DISMANTLE_HOST_DEVICE inline Vec3 closest_point_of_segment(Vec3 a, Vec3 b, Vec3 p) {
  const Vec3 ab = b - a;
  const double along = dot(p - a, ab), whole = dot(ab, ab);
  if (!(along > 0)) return a;
  return along >= whole ? b : a + (along / whole) * ab;
}

}  // namespace detail

/// The point of a closed triangle that is nearest to `p`. Robust for slivers and degenerate triangles, unlike
/// closest_points_vertex_face(), and slower for them: the point is one of the triangle and the nearest one, both up to
/// rounding. For other triangles the two differ in the last bits only.
DISMANTLE_HOST_DEVICE inline Vec3 closest_point_of_triangle(const Triangle& t, Vec3 p) {
  // Squared sine of an angle, roughly, from which on a triangle is no sliver.
  constexpr double kSliver = 1e-8;
  const Vec3 edge[3] = {t[2] - t[1], t[0] - t[2], t[1] - t[0]};  // opposite to the corners
  const Vec3 n = cross(edge[2], -edge[1]);
  const double longest = max(length_squared(edge[0]), max(length_squared(edge[1]), length_squared(edge[2])));
  const bool is_sliver = !(length_squared(n) > kSliver * longest * longest);
  const double weight[3] = {dot(n, cross(edge[0], p - t[1])), dot(n, cross(edge[1], p - t[2])),
                            dot(n, cross(edge[2], p - t[0]))};
  const bool is_above = weight[0] > 0 && weight[1] > 0 && weight[2] > 0;
  Vec3 best;
  double best_squared = std::numeric_limits<double>::infinity();
  const auto consider = [&](Vec3 q) {
    const double squared = length_squared(p - q);
    if (squared >= best_squared) return;
    best_squared = squared;
    best = q;
  };
  // The edges that the point is beyond; all of a sliver, whose weights are mostly rounding.
  for (int i = 0; i < 3; ++i)
    if (is_sliver || !(weight[i] > 0)) consider(detail::closest_point_of_segment(t[(i + 1) % 3], t[(i + 2) % 3], p));
  if (is_above) {
    const double sum = weight[0] + weight[1] + weight[2];
    consider(t[0] + (weight[1] / sum) * edge[2] - (weight[2] / sum) * edge[1]);
  }
  return best;
}

namespace detail {

/// `s` clamped to [0, 1]; 0 where it is not a number.
DISMANTLE_HOST_DEVICE inline double clamped_to_unit(double s) {
  return s > 0 ? (s < 1 ? s : 1) : 0;
}

}  // namespace detail

/// The closest points of two closed segments; one of the closest pairs where they are parallel, the point itself where
/// a length is zero (Ericson, Real-Time Collision Detection, 5.1.9).
DISMANTLE_HOST_DEVICE inline ClosestPoints closest_points_edge_edge(const Vec3 (&a)[2], const Vec3 (&b)[2]) {
  const Vec3 along_a = a[1] - a[0], along_b = b[1] - b[0], between = a[0] - b[0];
  const double aa = length_squared(along_a), bb = length_squared(along_b);
  const double f = dot(along_b, between);
  if (!(aa > 0)) return {a[0], bb > 0 ? b[0] + detail::clamped_to_unit(f / bb) * along_b : b[0]};
  const double c = dot(along_a, between);
  if (!(bb > 0)) return {a[0] + detail::clamped_to_unit(-c / aa) * along_a, b[0]};

  const double ab = dot(along_a, along_b);
  const double denominator = aa * bb - ab * ab;
  double s = denominator > 0 ? detail::clamped_to_unit((ab * f - c * bb) / denominator) : 0;
  double t = ab * s + f;
  if (t < 0) {
    t = 0;
    s = detail::clamped_to_unit(-c / aa);
  } else if (t > bb) {
    t = 1;
    s = detail::clamped_to_unit((ab - c) / aa);
  } else {
    t /= bb;
  }
  return {a[0] + s * along_a, b[0] + t * along_b, s > 0 && s < 1 && t > 0 && t < 1};
}

}  // namespace dismantle
