// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/elementary_inside.h"

namespace dismantle {

namespace detail {

/// The extent of a motion, as kInsideTolerance defines it [mm].
DISMANTLE_HOST_DEVICE inline double largest_difference(const VertexFaceMotion& m) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    const double start = max_abs(m.face_t0[i] - m.vertex_t0), end = max_abs(m.face_t1[i] - m.vertex_t1);
    largest = largest > start ? largest : start;
    largest = largest > end ? largest : end;
  }
  return largest;
}

/// The times at which features that stay coplanar can begin to meet.
DISMANTLE_HOST_DEVICE inline CoplanarTimes coplanar_times(const VertexFaceMotion& m) {
  CoplanarTimes times;
  times.insert(0);
  times.insert(1);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec3 edge[2] = {m.face_t0[j] - m.face_t0[i], m.face_t1[j] - m.face_t1[i]};
    const Vec3 to_vertex[2] = {m.vertex_t0 - m.face_t0[i], m.vertex_t1 - m.face_t1[i]};
    insert_parallel_times(times, edge, to_vertex);
    insert_zero_times(times, to_vertex);
  }
  return times;
}

}  // namespace detail

/// As elementary_vertex_face(motion), for a caller that has computed the coplanarity cubic for the filter.
DISMANTLE_HOST_DEVICE inline CcdResult elementary_vertex_face(const VertexFaceMotion& m, const BernsteinCubic& cubic) {
  const auto distance_at = [&m](double t) {
    const Triangle face{detail::mixed(m.face_t0[0], m.face_t1[0], t), detail::mixed(m.face_t0[1], m.face_t1[1], t),
                        detail::mixed(m.face_t0[2], m.face_t1[2], t)};
    const ClosestPoints closest = closest_points_vertex_face(detail::mixed(m.vertex_t0, m.vertex_t1, t), face);
    return length(closest.point_a - closest.point_b);
  };
  const double reach = kInsideTolerance * detail::largest_difference(m);
  if (always_coplanar(cubic)) return detail::first_meeting(detail::coplanar_times(m), reach, distance_at);
  return detail::first_meeting(cubic_roots(cubic), reach, distance_at);
}

/// The paper's elementary test of a vertex against a face (Provot 1997; Bridson, Fedkiw, Anderson 2002; Du et al. 2015,
/// section 4.3): the first root of the coplanarity cubic at which the vertex is in the face within kInsideTolerance.
/// Linear vertex paths; touching counts. *Not certain*: rounding can lose a contact or report a near miss; `toi` is the
/// root up to rounding. Points that are coplanar all the time are tested where they can begin to meet.
DISMANTLE_HOST_DEVICE inline CcdResult elementary_vertex_face(const VertexFaceMotion& motion) {
  return elementary_vertex_face(motion, coplanarity_cubic(motion));
}

}  // namespace dismantle
