// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/aabb.h"
#include "dismantle/geometry/triangle.h"
#include "dismantle/math/orientation.h"

namespace dismantle::detail {

// The intersection of closed triangles that are coplanar or have no area, such as segments and points. All results are
// exact.

/// `p` without the coordinate `dropped`.
DISMANTLE_HOST_DEVICE inline Vec2 projected(Vec3 p, int dropped) {
  return dropped == 0 ? Vec2{p.y, p.z} : (dropped == 1 ? Vec2{p.z, p.x} : Vec2{p.x, p.y});
}

/// A coordinate without which a, b, c are not collinear; -1 where they are collinear.
DISMANTLE_HOST_DEVICE inline int faithful_projection(Vec3 a, Vec3 b, Vec3 c) {
  // The largest coordinate of the normal first: the floating-point filter nearly always decides it.
  const Vec3 n = magnitude(cross(b - a, c - a));
  const int first = n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
  for (int i = 0; i < 3; ++i) {
    const int k = (first + i) % 3;
    if (orient2d_sign(projected(a, k), projected(b, k), projected(c, k)) != 0) return k;
  }
  return -1;
}

/// True if an edge of `t` has all of `other` strictly on its outer side. Of two coplanar, not collinear sets without a
/// common point one has such an edge: the edge of their Minkowski difference that faces the origin. An edge on whose
/// line the third corner is has two outer sides.
DISMANTLE_HOST_DEVICE inline bool edge_separates(const Vec2 (&t)[3], const Vec2 (&other)[3]) {
  for (int i = 0; i < 3; ++i) {
    const Vec2 from = t[i], to = t[(i + 1) % 3];
    const int side = orient2d_sign(from, to, other[0]);
    if (side == 0 || orient2d_sign(from, to, other[1]) != side || orient2d_sign(from, to, other[2]) != side) continue;
    if (orient2d_sign(from, to, t[(i + 2) % 3]) != side) return true;
  }
  return false;
}

/// True if two coplanar triangles share a point. @pre dropping the coordinate is one-to-one on their plane
DISMANTLE_HOST_DEVICE inline bool intersect_projected(const Triangle& a, const Triangle& b, int dropped) {
  const Vec2 p[3] = {projected(a[0], dropped), projected(a[1], dropped), projected(a[2], dropped)};
  const Vec2 q[3] = {projected(b[0], dropped), projected(b[1], dropped), projected(b[2], dropped)};
  return !edge_separates(p, q) && !edge_separates(q, p);
}

/// The bounding box of a triangle.
DISMANTLE_HOST_DEVICE inline Aabb box_of(const Triangle& t) {
  return {min(t[0], min(t[1], t[2])), max(t[0], max(t[1], t[2]))};
}

/// True if the segment p-q and a triangle with area share a point. @pre face_projection is the face's
/// faithful_projection
DISMANTLE_HOST_DEVICE inline bool intersect_segment_face(Vec3 p, Vec3 q, const Triangle& face, int face_projection) {
  const OrientedPlane plane = oriented_plane(face[0], face[1], face[2]);
  const int side_p = side_of_plane(plane, p), side_q = side_of_plane(plane, q);
  if (side_p == 0 && side_q == 0) return intersect_projected({{p, q, q}}, face, face_projection);
  if (side_p == side_q) return false;
  // The line crosses the plane in one point: on the same side of all three edges if that is in the face.
  int turns[2] = {0, 0};
  for (int i = 0; i < 3; ++i) {
    const int side = orient3d_sign(p, q, face[i], face[(i + 1) % 3]);
    turns[0] += side < 0;
    turns[1] += side > 0;
  }
  return turns[0] == 0 || turns[1] == 0;
}

/// As intersect_flat(), for `edges` without area: it is the union of its edges.
DISMANTLE_HOST_DEVICE inline bool intersect_edges_face(const Triangle& edges, const Triangle& face,
                                                       int face_projection) {
  for (int i = 0; i < 3; ++i)
    if (intersect_segment_face(edges[i], edges[(i + 1) % 3], face, face_projection)) return true;
  return false;
}

/// As intersect_flat(), for two triangles without area.
DISMANTLE_HOST_DEVICE inline bool intersect_lines(const Triangle& a, const Triangle& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (orient3d_sign(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]) != 0) return false;
  // All are coplanar. A point of one beside the line of the other gives a faithful projection.
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int of_a = faithful_projection(a[i], a[(i + 1) % 3], b[j]);
      if (of_a >= 0) return intersect_projected(a, b, of_a);
      const int of_b = faithful_projection(b[i], b[(i + 1) % 3], a[j]);
      if (of_b >= 0) return intersect_projected(a, b, of_b);
    }
  }
  // All are collinear: the intervals share a point if their boxes do.
  return true;
}

/// True if two triangles share a point. Not inlined, to keep the code of the crossing case small. @pre the triangles
/// are coplanar, or one of them has no area
[[gnu::noinline]] DISMANTLE_HOST_DEVICE inline bool intersect_flat(const Triangle& a, const Triangle& b) {
  if (!overlaps(box_of(a), box_of(b))) return false;
  const int projection_a = faithful_projection(a[0], a[1], a[2]);
  const int projection_b = faithful_projection(b[0], b[1], b[2]);
  if (projection_a >= 0 && projection_b >= 0) return intersect_projected(a, b, projection_a);
  if (projection_a >= 0) return intersect_edges_face(b, a, projection_a);
  if (projection_b >= 0) return intersect_edges_face(a, b, projection_b);
  return intersect_lines(a, b);
}

}  // namespace dismantle::detail
