// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/near_two_faces.h"

#include "dismantle/geometry/triangle.h"

#include <algorithm>

namespace dismantle {

namespace {

/// A plane by the height of points above it.
struct Plane {
  Vec3 normal;
  double offset = 0;

  double above(Vec3 p) const { return dot(normal, p) - offset; }
};

/// The plane of a face, with a point above it.
Plane plane_below(const Triangle& face, Vec3 point) {
  const Vec3 normal = normalized(normal_unscaled(face));
  const Plane plane{normal, dot(normal, face[0])};
  return plane.above(point) < 0 ? Plane{-plane.normal, -plane.offset} : plane;
}

}  // namespace

bool near_two_faces(const SurfaceTree& surface, Span<const Vec3> corners, std::uint32_t face, double limit) {
  Vec3 middle;
  double farthest = 0;
  Vec3 corner;  // the one that is furthest from the face
  for (const Vec3& p : corners) {
    middle += p / static_cast<double>(corners.size());
    const double distance = surface.distance_to_face(p, face);
    if (distance < farthest) continue;
    farthest = distance;
    corner = p;
  }
  if (farthest <= limit) return true;
  const MeshDistance nearest = surface.distance(corner, face);
  if (nearest.distance > limit || nearest.face == face) return false;
  // Any plane will do; where the planes of both faces are as near, the sides are as near to one face as they can be.
  const Plane first = plane_below(surface.triangle(face), middle);
  const Plane second = plane_below(surface.triangle(nearest.face), corner);
  const Plane divides{first.normal - second.normal, first.offset - second.offset};
  // The distance from a triangle is a convex function: it is greatest at a corner of a side.
  const auto within = [&](Vec3 p, std::uint32_t of) { return surface.distance_to_face(p, of) <= limit; };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double height = divides.above(corners[i]);
    if (!within(corners[i], height > 0 ? nearest.face : face)) return false;
    for (std::size_t k = 0; k < i; ++k) {
      const double other = divides.above(corners[k]);
      if ((height > 0) == (other > 0)) continue;
      const Vec3 between = corners[i] + height / (height - other) * (corners[k] - corners[i]);
      if (!within(between, face) || !within(between, nearest.face)) return false;
    }
  }
  return true;
}

}  // namespace dismantle
