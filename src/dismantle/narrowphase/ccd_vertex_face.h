// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_feature_pair.h"
#include "dismantle/narrowphase/closest_points.h"

namespace dismantle {

namespace detail {

/// A vertex (A) and a face (B) for conservative_advancement().
class VertexFacePair : public FeaturePair<1, 3> {
 public:
  /// @param cubic coplanarity_cubic(m); must outlive the pair
  DISMANTLE_HOST_DEVICE VertexFacePair(const VertexFaceMotion& m, const BernsteinCubic& cubic)
      : FeaturePair(&m.vertex_t0, &m.vertex_t1, m.face_t0.corner, m.face_t1.corner, cubic) {}

  /// The axis to the closest point of the face at `t`.
  DISMANTLE_HOST_DEVICE AxisGuess guess(double t) const {
    const ClosestPoints closest = closest_points_vertex_face({}, face_at(t));
    return {closest.point_b, closest.interior};
  }

  /// Tries the face's normal, the normals of its edges in its plane, and the directions to its corners.
  DISMANTLE_HOST_DEVICE void consider_all(Axes& best, double t) const {
    const Triangle face = face_at(t);
    const Vec3 normal = normal_unscaled(face);
    best.consider_both_signs(normal);
    for (int i = 0; i < 3; ++i) {
      best.consider_both_signs(cross(normal, face[(i + 1) % 3] - face[i]));
      best.consider(face[i]);
    }
  }

 private:
  DISMANTLE_HOST_DEVICE Triangle face_at(double t) const {
    Triangle face;
    for (int j = 0; j < 3; ++j) face[j] = (1 - t) * hulls_.b[0][j] + t * hulls_.b[1][j];
    return face;
  }
};

}  // namespace detail

/// As ccd_vertex_face(motion), but tries `hint` first (from the vertex to the face, any length; zero for none) and
/// returns the last axis too.
DISMANTLE_HOST_DEVICE inline AxisCcdResult ccd_vertex_face(const VertexFaceMotion& motion, Vec3 hint) {
  return detail::ccd_feature_pair<detail::VertexFacePair>(motion, hint);
}

/// The certified continuous test of a vertex against a face with linear vertex paths.
///   1. Free is certain: the closed face and the vertex share no point at any time, despite rounding.
///   2. Contact: the motion is certainly free on [0, toi), so toi is never later than the first contact.
///   3. Contact is reported where they come closer than rounding can resolve (some 1e-15 of the largest coordinate
///      difference), or where the steps of AdvancementLimits do not decide.
/// No false negative by proof: docs/design/0001-certified-ccd.md.
DISMANTLE_HOST_DEVICE inline CcdResult ccd_vertex_face(const VertexFaceMotion& motion) {
  return ccd_vertex_face(motion, Vec3{}).ccd;
}

}  // namespace dismantle
