// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/conservative_advancement.h"
#include "dismantle/narrowphase/coplanarity_advance.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"

namespace dismantle {

namespace detail {

/// What conservative_advancement needs to know about two edges.
class EdgeEdgePair {
 public:
  using Axes = FurthestAxis<2, 2>;

  DISMANTLE_HOST_DEVICE EdgeEdgePair(const EdgeEdgeMotion& m, const BernsteinCubic& cubic)
      : hulls_(m.a_t0, m.a_t1, m.b_t0, m.b_t1), cubic_(cubic) {}

  DISMANTLE_HOST_DEVICE const RelativeHulls<2, 2>& hulls() const { return hulls_; }

  DISMANTLE_HOST_DEVICE bool start(Axes&) const { return false; }
  DISMANTLE_HOST_DEVICE void look_ahead(Axes&, double) const {}

  DISMANTLE_HOST_DEVICE AxisGuess guess(double t) const {
    const Edges now = edges_at(t);
    const ClosestPoints closest = closest_points_edge_edge(now.a, now.b);
    return {closest.point_b - closest.point_a, closest.interior};
  }

  DISMANTLE_HOST_DEVICE double advance(double t) const { return coplanarity_advance(cubic_, t); }

  /// The edges' common normal, the normals of each in the plane of both, and the directions between end points.
  DISMANTLE_HOST_DEVICE void consider_all(Axes& best, double t) const {
    const Edges now = edges_at(t);
    const Vec3 along_a = now.a[1], along_b = now.b[1] - now.b[0];
    const Vec3 normal = cross(along_a, along_b);
    best.consider_both_ways(normal);
    best.consider_both_ways(cross(normal, along_a));
    best.consider_both_ways(cross(normal, along_b));
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

  RelativeHulls<2, 2> hulls_;
  const BernsteinCubic& cubic_;
};

}  // namespace detail

/// As ccd_edge_edge(motion), trying `hint` first (from edge a to edge b, any length; zero for none) and giving the axis
/// that it ended on.
DISMANTLE_HOST_DEVICE inline AxisCcdResult ccd_edge_edge(const EdgeEdgeMotion& motion, Vec3 hint) {
  const BernsteinCubic cubic = coplanarity_cubic(motion);
  if (certainly_never_coplanar(cubic)) return {{}, hint};
  const detail::EdgeEdgePair pair(motion, cubic);
  return conservative_advancement(pair, detail::EdgeEdgePair::Axes(pair.hulls(), 0, hint));
}

/// The certified test of two edges (docs/design/0001-certified-ccd.md). Linear vertex paths.
///   1. Free is certain: the closed segments share no point at any instant, despite rounding.
///   2. Contact: there is certainly none on [0, toi), so toi is never later than the first contact.
///   3. Contact is reported where they come closer than rounding can tell apart (some 1e-15 of the largest coordinate
///      difference), or where the steps of AdvancementLimits do not settle it.
/// No false negative by proof: docs/design/0001-certified-ccd.md.
DISMANTLE_HOST_DEVICE inline CcdResult ccd_edge_edge(const EdgeEdgeMotion& motion) {
  return ccd_edge_edge(motion, Vec3{}).ccd;
}

}  // namespace dismantle
