// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/cubic_roots.h"

namespace dismantle {

/// The tolerance of the elementary tests: at a root of the coplanarity cubic two features meet if the distance of their
/// closest points is at most this part of the motion's extent (the largest coordinate difference of the four points at
/// both ends). A smaller value loses contacts to the rounding of the root, a larger one reports near misses.
inline constexpr double kInsideTolerance = 1e-10;

/// The times at which features that are coplanar all the time can begin to meet: both ends, where a point is on the
/// line of an edge, and where two points coincide; per coordinate, as the plane may turn. At most 2 + 3 * 3 * 2 + 3 * 3
/// for vertex-face, 2 + 4 * 3 * 2 + 4 * 3 for edge-edge.
using CoplanarTimes = TimeList<38>;

namespace detail {

/// Linear interpolation.
DISMANTLE_HOST_DEVICE inline Vec3 mixed(Vec3 at_t0, Vec3 at_t1, double t) {
  return (1 - t) * at_t0 + t * at_t1;
}

/// Adds the times at which a coordinate of a x b is zero, for two vectors that change linearly.
DISMANTLE_HOST_DEVICE inline void insert_parallel_times(CoplanarTimes& times, const Vec3 (&a)[2], const Vec3 (&b)[2]) {
  const Vec3 start = cross(a[0], b[0]), end = cross(a[1], b[1]);
  const Vec3 middle = 0.5 * (cross(a[0], b[1]) + cross(a[1], b[0]));
  for (int k = 0; k < 3; ++k) {
    const TimeList<2> roots = quadratic_roots(start[k], middle[k], end[k]);
    for (int i = 0; i < roots.count; ++i) times.insert(roots.time[i]);
  }
}

/// Adds the times at which a coordinate of a vector that changes linearly is zero.
DISMANTLE_HOST_DEVICE inline void insert_zero_times(CoplanarTimes& times, const Vec3 (&a)[2]) {
  for (int k = 0; k < 3; ++k)
    if (a[0][k] != a[1][k]) times.insert(a[0][k] / (a[0][k] - a[1][k]));
}

/// Contact at the first of the times at which `distance_at` is at most `reach`, else Free.
template <int kCapacity, class DistanceAt>
DISMANTLE_HOST_DEVICE CcdResult first_meeting(const TimeList<kCapacity>& times, double reach,
                                              const DistanceAt& distance_at) {
  for (int i = 0; i < times.count; ++i)
    if (distance_at(times.time[i]) <= reach) return {CcdStatus::Contact, times.time[i], i + 1};
  return {CcdStatus::Free, 1, times.count};
}

}  // namespace detail

}  // namespace dismantle
