// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/elementary_inside.h"

namespace dismantle {

namespace detail {

/// The extent of a motion, as kInsideTolerance defines it [mm].
DISMANTLE_HOST_DEVICE inline double largest_difference(const EdgeEdgeMotion& m) {
  double largest = 0;
  const Vec3 differences[6] = {m.a_t0[1] - m.a_t0[0], m.b_t0[0] - m.a_t0[0], m.b_t0[1] - m.a_t0[0],
                               m.a_t1[1] - m.a_t1[0], m.b_t1[0] - m.a_t1[0], m.b_t1[1] - m.a_t1[0]};
  for (const Vec3& d : differences) largest = largest > max_abs(d) ? largest : max_abs(d);
  return largest;
}

/// The times at which features that stay coplanar can begin to meet.
DISMANTLE_HOST_DEVICE inline CoplanarTimes coplanar_times(const EdgeEdgeMotion& m) {
  CoplanarTimes times;
  times.insert(0);
  times.insert(1);
  const Vec3 along_a[2] = {m.a_t0[1] - m.a_t0[0], m.a_t1[1] - m.a_t1[0]};
  const Vec3 along_b[2] = {m.b_t0[1] - m.b_t0[0], m.b_t1[1] - m.b_t1[0]};
  for (int i = 0; i < 2; ++i) {
    insert_parallel_times(times, along_a, {m.b_t0[i] - m.a_t0[0], m.b_t1[i] - m.a_t1[0]});
    insert_parallel_times(times, along_b, {m.a_t0[i] - m.b_t0[0], m.a_t1[i] - m.b_t1[0]});
    for (int j = 0; j < 2; ++j) insert_zero_times(times, {m.b_t0[j] - m.a_t0[i], m.b_t1[j] - m.a_t1[i]});
  }
  return times;
}

}  // namespace detail

/// As elementary_edge_edge(motion), for a caller that has computed the coplanarity cubic for the filter.
DISMANTLE_HOST_DEVICE inline CcdResult elementary_edge_edge(const EdgeEdgeMotion& m, const BernsteinCubic& cubic) {
  const auto distance_at = [&m](double t) {
    const Vec3 a[2] = {detail::mixed(m.a_t0[0], m.a_t1[0], t), detail::mixed(m.a_t0[1], m.a_t1[1], t)};
    const Vec3 b[2] = {detail::mixed(m.b_t0[0], m.b_t1[0], t), detail::mixed(m.b_t0[1], m.b_t1[1], t)};
    const ClosestPoints closest = closest_points_edge_edge(a, b);
    return length(closest.point_a - closest.point_b);
  };
  const double reach = kInsideTolerance * detail::largest_difference(m);
  if (always_coplanar(cubic)) return detail::first_meeting(detail::coplanar_times(m), reach, distance_at);
  return detail::first_meeting(cubic_roots(cubic), reach, distance_at);
}

/// The paper's elementary test of two edges (Provot 1997; Bridson, Fedkiw, Anderson 2002; Du et al. 2015, section 4.3):
/// the first root of the coplanarity cubic at which the segments meet within kInsideTolerance. Linear vertex paths;
/// touching counts. *Not certain*, as elementary_vertex_face(). Edges that are coplanar all the time, parallel ones
/// too, are tested where they can begin to meet.
DISMANTLE_HOST_DEVICE inline CcdResult elementary_edge_edge(const EdgeEdgeMotion& motion) {
  return elementary_edge_edge(motion, coplanarity_cubic(motion));
}

}  // namespace dismantle
