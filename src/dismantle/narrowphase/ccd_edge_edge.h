// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_feature_pair.h"
#include "dismantle/narrowphase/closest_points.h"

namespace dismantle {

namespace detail {

/// Two edges for conservative_advancement().
class EdgeEdgePair : public FeaturePair<2, 2> {
 public:
  /// @param cubic coplanarity_cubic(m); must outlive the pair
  DISMANTLE_HOST_DEVICE EdgeEdgePair(const EdgeEdgeMotion& m, const BernsteinCubic& cubic)
      : FeaturePair(m.a_t0, m.a_t1, m.b_t0, m.b_t1, cubic) {}

  /// The axis between the closest points at `t`.
  DISMANTLE_HOST_DEVICE AxisGuess guess(double t) const {
    const Edges now = edges_at(t);
    const ClosestPoints closest = closest_points_edge_edge(now.a, now.b);
    return {closest.point_b - closest.point_a, closest.interior};
  }

  /// Tries the edges' common normal, the normals of each in the plane of both, and the directions between end points.
  DISMANTLE_HOST_DEVICE void consider_all(Axes& best, double t) const {
    const Edges now = edges_at(t);
    const Vec3 along_a = now.a[1], along_b = now.b[1] - now.b[0];
    const Vec3 normal = cross(along_a, along_b);
    best.consider_both_signs(normal);
    best.consider_both_signs(cross(normal, along_a));
    best.consider_both_signs(cross(normal, along_b));
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) best.consider(now.b[j] - now.a[i]);
  }

 private:
  struct Edges {
    Vec3 a[2], b[2];
  };
  DISMANTLE_HOST_DEVICE Edges edges_at(double t) const {
    Edges now;
    now.a[1] = (1 - t) * hulls_.a[0][1] + t * hulls_.a[1][1];
    for (int j = 0; j < 2; ++j) now.b[j] = (1 - t) * hulls_.b[0][j] + t * hulls_.b[1][j];
    return now;
  }
};

}  // namespace detail

/// As ccd_edge_edge(motion), but tries `hint` first (from edge a to edge b, any length; zero for none) and returns the
/// last axis too.
DISMANTLE_HOST_DEVICE inline AxisCcdResult ccd_edge_edge(const EdgeEdgeMotion& motion, Vec3 hint) {
  return detail::ccd_feature_pair<detail::EdgeEdgePair>(motion, hint);
}

/// The certified continuous test of two edges with linear vertex paths.
///   1. Free is certain: the closed segments share no point at any time, despite rounding.
///   2. Contact: the motion is certainly free on [0, toi), so toi is never later than the first contact.
///   3. Contact is reported where the edges come closer than rounding can resolve (some 1e-15 of the largest coordinate
///      difference), or where the steps of AdvancementLimits do not decide.
/// No false negative by proof: docs/design/0001-certified-ccd.md.
DISMANTLE_HOST_DEVICE inline CcdResult ccd_edge_edge(const EdgeEdgeMotion& motion) {
  return ccd_edge_edge(motion, Vec3{}).ccd;
}

}  // namespace dismantle
