// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"
#include "dismantle/math/rigid_transform.h"

namespace dismantle::audit {

/// The squared sine of an angle below which two edges are nearly parallel, so that rounding turns their cross product.
inline constexpr double kNearlyParallelSineSquared = 1e-6;

/// The unit vector of a x b; zero where a and b are parallel up to rounding. For nearly parallel edges the result is
/// made perpendicular to the longer one again: the remaining error turns it about that edge only, which moves the facet
/// of the Minkowski difference that it represents by no more than rounding times the shorter edge.
inline Vec3 unit_cross(Vec3 a, Vec3 b) {
  constexpr double kParallelSineSquared = 1e-30;
  const Vec3 c = cross(a, b);
  const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  if (!(cc > kParallelSineSquared * aa * bb)) return {};
  const Vec3 w = c / std::sqrt(cc);
  if (cc > kNearlyParallelSineSquared * aa * bb) return w;
  const Vec3 longer = aa > bb ? a : b;
  return normalized(w - (dot(w, longer) / dot(longer, longer)) * longer);
}

/// The unit normal of a triangle, from its longest edge and the next one; zero where its corners are collinear.
inline Vec3 unit_normal(const Triangle& t) {
  const Vec3 e[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if (dot(e[k], e[k]) > dot(e[longest], e[longest])) longest = k;
  return unit_cross(e[longest], e[(longest + 1) % 3]);
}

/// Calls visit(axis) until it returns false for the unit axes that separate two triangles: the direction between their
/// centres, the 2 face normals and the 9 edge cross products, together the facet normals of the Minkowski difference,
/// and the 6 in-plane edge normals, which separate coplanar triangles. Every axis is sound: it gives an upper bound of
/// the depth and a lower bound of the distance; the 11 facet normals make the depth exact.
template <class Visit>
void for_each_axis(const Triangle& a, const Triangle& b, const Visit& visit) {
  const auto try_axis = [&visit](Vec3 w) { return w == Vec3{} || visit(w); };
  if (!try_axis(normalized((b[0] - a[0]) + (b[1] - a[1]) + (b[2] - a[2])))) return;
  const Vec3 normal_a = unit_normal(a), normal_b = unit_normal(b);
  if (!try_axis(normal_a) || !try_axis(normal_b)) return;
  Vec3 edge_a[3], edge_b[3];
  for (int k = 0; k < 3; ++k) {
    edge_a[k] = a[(k + 1) % 3] - a[k];
    edge_b[k] = b[(k + 1) % 3] - b[k];
  }
  for (const Vec3& ea : edge_a)
    for (const Vec3& eb : edge_b)
      if (!try_axis(unit_cross(ea, eb))) return;
  for (int k = 0; k < 3; ++k) {
    if (!try_axis(unit_cross(normal_a, edge_a[k]))) return;
    if (!try_axis(unit_cross(normal_b, edge_b[k]))) return;
  }
}

/// The largest projection of a triangle on an axis.
inline double highest(const Triangle& t, Vec3 axis) {
  const double p0 = dot(t[0], axis), p1 = dot(t[1], axis), p2 = dot(t[2], axis);
  const double p01 = p0 > p1 ? p0 : p1;
  return p01 > p2 ? p01 : p2;
}

/// The smallest projection of a triangle on an axis.
inline double lowest(const Triangle& t, Vec3 axis) {
  return -highest(t, -axis);
}

/// A triangle, transformed.
inline Triangle transformed(const RigidTransform& transform, const Triangle& t) {
  return {{transform * t[0], transform * t[1], transform * t[2]}};
}

/// A directed axis and the gap from a to b along it.
struct AxisGap {
  Vec3 axis;       ///< Of unit length.
  double gap = 0;  ///< [mm]; the overlap where negative.
};

/// The direction of an axis with the larger gap.
inline AxisGap wider_gap(const Triangle& a, const Triangle& b, Vec3 axis) {
  const double forward = lowest(b, axis) - highest(a, axis);
  const double backward = lowest(a, axis) - highest(b, axis);
  return forward >= backward ? AxisGap{axis, forward} : AxisGap{-axis, backward};
}

/// The largest gap over all axes, or the first that is larger than `sufficient`. Where it is not positive, its negative
/// is the depth: the length of the shortest translation that separates the triangles; 0 for coplanar ones.
inline AxisGap widest_gap(const Triangle& a, const Triangle& b, double sufficient) {
  AxisGap widest{{}, -1e300};
  for_each_axis(a, b, [&](Vec3 axis) {
    const AxisGap found = wider_gap(a, b, axis);
    if (found.gap > widest.gap) widest = found;
    return widest.gap <= sufficient;
  });
  return widest;
}

}  // namespace dismantle::audit
