// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/orientation.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "tests/support/exact_triangles.h"
#include "tests/support/triangle_pairs.h"

#include <algorithm>
#include <cstdint>

/// Checks the predicates of triangle pairs against the exact oracle.
namespace dismantle::scenes {

/// Counts of checks and of wrong results.
struct PairCheck {
  std::int64_t pairs = 0, meeting = 0;
  std::int64_t signs = 0, wrong_signs = 0;  ///< Orientation signs.
  std::int64_t wrong_intersections = 0;     ///< Of a and b, or of b and a.
  std::int64_t wrong_depths = 0;            ///< Beyond the stated error, or not 0 for pairs that are apart or coplanar.
  std::int64_t wrong_distances = 0;         ///< Beyond the stated error, or points beside their triangles.
  double worst_distance_error = 0;          ///< As below.
  double worst_depth_error = 0;             ///< Relative to the largest coordinate difference.

  bool passed() const {
    return wrong_signs == 0 && wrong_intersections == 0 && wrong_depths == 0 && wrong_distances == 0;
  }
  void add(const PairCheck& c) {
    pairs += c.pairs, meeting += c.meeting, signs += c.signs, wrong_signs += c.wrong_signs;
    wrong_intersections += c.wrong_intersections, wrong_depths += c.wrong_depths;
    wrong_distances += c.wrong_distances;
    worst_distance_error = std::max(worst_distance_error, c.worst_distance_error);
    worst_depth_error = std::max(worst_depth_error, c.worst_depth_error);
  }
};

inline double largest_difference(const TrianglePair& pair) {
  double largest = 0;
  for (const Triangle* t : {&pair.a, &pair.b})
    for (const Vec3& p : t->corner)
      for (const Triangle* other : {&pair.a, &pair.b})
        for (const Vec3& q : other->corner) largest = std::max(largest, max_abs(p - q));
  return largest;
}

inline void check_signs(PairCheck& check, const TrianglePair& pair, const exact::Corners& a, const exact::Corners& b) {
  const exact::Point normal = exact::cross(b[1] - b[0], b[2] - b[0]);
  for (int i = 0; i < 3; ++i) {
    ++check.signs;
    check.wrong_signs += orient3d_sign(pair.b[0], pair.b[1], pair.b[2], pair.a[i]) != dot(normal, a[i] - b[0]).sign();
    for (int j = 0; j < 3; ++j) {
      const int i_end = (i + 1) % 3, j_end = (j + 1) % 3;
      const exact::Integer volume = dot(exact::cross(a[i_end] - a[i], b[j] - a[i]), b[j_end] - a[i]);
      ++check.signs;
      check.wrong_signs += orient3d_sign(pair.a[i], pair.a[i_end], pair.b[j], pair.b[j_end]) != volume.sign();
    }
  }
}

/// The overlap that remains along the axis after `b` has moved by the depth.
inline double left_overlap(const TrianglePair& pair, const Penetration& p) {
  double a_upper = -INFINITY, b_lower = INFINITY;
  for (int i = 0; i < 3; ++i) {
    a_upper = std::max(a_upper, dot(p.axis, pair.a[i] - pair.a[0]));
    b_lower = std::min(b_lower, dot(p.axis, pair.b[i] - pair.a[0]));
  }
  return a_upper - (b_lower + p.depth);
}

/// @param exact_depth 0 if and only if the triangles are apart, touch or are coplanar
inline void check_depth(PairCheck& check, const TrianglePair& pair, double exact_depth) {
  const double size = largest_difference(pair);
  for (const TrianglePair& order : {pair, TrianglePair{pair.b, pair.a}}) {
    const Penetration p = penetration_triangle_triangle(order.a, order.b);
    const double error = std::fabs(p.depth - exact_depth) / (size > 0 ? size : 1);
    check.worst_depth_error = std::max(check.worst_depth_error, error);
    const bool unit_axis = p.depth == 0 ? p.axis == Vec3{} : std::fabs(length(p.axis) - 1) < 1e-15;
    const bool parted = p.depth == 0 || left_overlap(order, p) <= kPenetrationRelativeError * size;
    check.wrong_depths += !(error <= kPenetrationRelativeError) || !unit_axis || !parted;
  }
}

/// The exact distance of the point from the triangle, relative to `size`.
inline double off_triangle(Vec3 p, const Triangle& t, double size) {
  const exact::Scaled s = exact::scaled({p, t[0], t[1], t[2]});
  const exact::Corners face(s.points.begin() + 1, s.points.end());
  return static_cast<double>(exact::point_distance(s.points[0], face, s.unit)) / size;
}

inline void check_distance(PairCheck& check, const TrianglePair& pair, bool meet, double exact_distance) {
  const double difference = largest_difference(pair), size = difference > 0 ? difference : 1;
  double coordinate = 0;
  for (const Triangle* t : {&pair.a, &pair.b})
    for (const Vec3& p : t->corner) coordinate = std::max(coordinate, max_abs(p));
  const double rounding = 4 * 0x1p-53 * coordinate / size;
  for (const TrianglePair& order : {pair, TrianglePair{pair.b, pair.a}}) {
    const TriangleDistance d = distance_triangle_triangle(order.a, order.b);
    const double error = std::fabs(d.distance - exact_distance) / size;
    check.worst_distance_error = std::max(check.worst_distance_error, error);
    const double off = std::max({off_triangle(d.point_a, order.a, size), off_triangle(d.point_b, order.b, size),
                                 std::fabs(length(d.point_b - d.point_a) - d.distance) / size});
    const bool zero = d.distance == 0;
    check.wrong_distances +=
        !(error <= kDistanceRelativeError) || !(off <= kDistanceRelativeError + rounding) || (meet && !zero);
  }
}

/// All checks of one pair.
inline PairCheck check_pair(const TrianglePair& pair) {
  PairCheck check;
  check.pairs = 1;
  const exact::Scaled s = exact::scaled({pair.a[0], pair.a[1], pair.a[2], pair.b[0], pair.b[1], pair.b[2]});
  const exact::Corners a(s.points.begin(), s.points.begin() + 3), b(s.points.begin() + 3, s.points.end());
  check_signs(check, pair, a, b);

  const bool meet = exact::triangles_meet(a, b);
  check.meeting = meet;
  check.wrong_intersections += intersect_triangle_triangle(pair.a, pair.b) != meet;
  check.wrong_intersections += intersect_triangle_triangle(pair.b, pair.a) != meet;
  const bool coplanar = meet && exact::coplanar(a, b);
  for (const Penetration& p :
       {penetration_triangle_triangle(pair.a, pair.b), penetration_triangle_triangle(pair.b, pair.a)})
    check.wrong_depths += p.depth != 0 && (!meet || coplanar);

  check_depth(check, pair, meet ? static_cast<double>(exact::overlap(a, b, s.unit)) : 0);
  check_distance(check, pair, meet, meet ? 0 : static_cast<double>(exact::distance(a, b, s.unit)));
  return check;
}

}  // namespace dismantle::scenes
