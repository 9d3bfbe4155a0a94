// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/conservative_advancement.h"
#include "dismantle/narrowphase/coplanarity_advance.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"

namespace dismantle {

namespace detail {

/// What conservative_advancement needs to know about a vertex (A) and a face (B).
class VertexFacePair {
 public:
  using Axes = FurthestAxis<1, 3>;

  DISMANTLE_HOST_DEVICE VertexFacePair(const VertexFaceMotion& m, const BernsteinCubic& cubic)
      : hulls_(&m.vertex_t0, &m.vertex_t1, m.face_t0.corner, m.face_t1.corner), cubic_(cubic) {}

  DISMANTLE_HOST_DEVICE const RelativeHulls<1, 3>& hulls() const { return hulls_; }

  DISMANTLE_HOST_DEVICE bool start(Axes&) const { return false; }
  DISMANTLE_HOST_DEVICE void look_ahead(Axes&, double) const {}

  DISMANTLE_HOST_DEVICE AxisGuess guess(double t) const {
    const ClosestPoints closest = closest_points_vertex_face({}, face_at(t));
    return {closest.point_b, closest.interior};
  }

  DISMANTLE_HOST_DEVICE double advance(double t) const { return coplanarity_advance(cubic_, t); }

  /// The face's normal, the normals of its edges in its plane, and the directions to its corners.
  DISMANTLE_HOST_DEVICE void consider_all(Axes& best, double t) const {
    const Triangle face = face_at(t);
    const Vec3 normal = normal_unscaled(face);
    best.consider_both_ways(normal);
    for (int i = 0; i < 3; ++i) {
      best.consider_both_ways(cross(normal, face[(i + 1) % 3] - face[i]));
      best.consider(face[i]);
    }
  }

 private:
  DISMANTLE_HOST_DEVICE Triangle face_at(double t) const {
    Triangle face;
    for (int j = 0; j < 3; ++j) face[j] = (1 - t) * hulls_.b[0][j] + t * hulls_.b[1][j];
    return face;
  }

  RelativeHulls<1, 3> hulls_;
  const BernsteinCubic& cubic_;
};

}  // namespace detail

/// As ccd_vertex_face(motion), trying `hint` first (from the vertex to the face, any length; zero for none) and giving
/// the axis that it ended on.
DISMANTLE_HOST_DEVICE inline AxisCcdResult ccd_vertex_face(const VertexFaceMotion& motion, Vec3 hint) {
  const BernsteinCubic cubic = coplanarity_cubic(motion);
  if (certainly_never_coplanar(cubic)) return {{}, hint};
  const detail::VertexFacePair pair(motion, cubic);
  return conservative_advancement(pair, detail::VertexFacePair::Axes(pair.hulls(), 0, hint));
}

/// The certified test of a vertex against a face (docs/design/0001-certified-ccd.md). Linear vertex paths.
///   1. Free is certain: the closed face and the vertex share no point at any instant, despite rounding.
///   2. Contact: there is certainly none on [0, toi), so toi is never later than the first contact.
///   3. Contact is reported where they come closer than rounding can tell apart (some 1e-15 of the largest coordinate
///      difference), or where the steps of AdvancementLimits do not settle it.
/// No false negative by proof: docs/design/0001-certified-ccd.md.
DISMANTLE_HOST_DEVICE inline CcdResult ccd_vertex_face(const VertexFaceMotion& motion) {
  return ccd_vertex_face(motion, Vec3{}).ccd;
}

}  // namespace dismantle
