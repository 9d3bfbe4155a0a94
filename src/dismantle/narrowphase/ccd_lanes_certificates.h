// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_lanes_gather.h"

/// Certificates in lanes of float that prove a motion free, for lane kernels only (math/lanes.h).
/// docs/design/0005-lanes.md derives the bounds; u = 2^-24.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// The error bound of a projected gap on an axis w in units of |w_x| M_x + |w_y| M_y + |w_z| M_z, M being the reach: 10
/// u and terms of second order are derived, the rest is margin for the rounding of the bound itself.
inline constexpr float kLaneGapError = 12 * 0x1p-24f;

///@{ The error bounds of the coplanarity cubic's coefficients in units of M_x M_y M_z: 48 u is derived for the first
/// and
/// the last, 174 u for three times the others.
inline constexpr float kLaneCornerError = 64 * 0x1p-24f;
inline constexpr float kLaneMiddleError = 224 * 0x1p-24f;
///@}

/// Covers all products and sums that underflow, flushed to zero or not.
inline constexpr float kLaneUnderflow = 0x1p-110f;

/// The smallest reach: covers coordinates that underflow in the conversion to float.
inline constexpr float kLaneMinReach = 0x1p-100f;

/// No product of three coordinates overflows where the coordinates of the reach add up to less.
inline constexpr float kLaneMaxReach = 0x1p40f;

/// In each lane `a` where the mask is set, else `b`.
template <int N>
LaneVec<N> select(LaneMask<N> mask, LaneVec<N> a, LaneVec<N> b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// The largest absolute value of each coordinate over all points and both ends, at least kLaneMinReach; infinite
/// where one is.
template <int N>
LaneVec<N> reach_of(const RelativePoints<N>& points) {
  const Lanes<N> smallest = kLaneMinReach;
  LaneVec<N> reach = {smallest, smallest, smallest};
  for (const auto& end : points.at)
    for (const LaneVec<N>& p : end) reach = {max(reach.x, abs(p.x)), max(reach.y, abs(p.y)), max(reach.z, abs(p.z))};
  return reach;
}

/// Error bound of a projected gap on `w`; infinite or NaN where something overflows.
template <int N>
Lanes<N> gap_error(LaneVec<N> w, LaneVec<N> reach) {
  return kLaneGapError * (abs(w.x) * reach.x + abs(w.y) * reach.y + abs(w.z) * reach.z) + kLaneUnderflow;
}

/// The lanes whose four points are certainly never coplanar, so that their features do not meet: the Bernstein
/// coefficients of the volume, a cubic in time, certainly have one strict sign (the non-penetration filter).
template <int N>
LaneMask<N> never_coplanar(const RelativePoints<N>& points, LaneVec<N> reach) {
  using L = Lanes<N>;
  const LaneVec<N>(&p)[3] = points.at[0];
  const LaneVec<N>(&q)[3] = points.at[1];
  const LaneVec<N> start = cross(p[1], p[2]), end = cross(q[1], q[2]);
  const LaneVec<N> twice_middle = cross(p[1], q[2]) + cross(q[1], p[2]);
  const L c0 = dot(start, p[0]), c3 = dot(end, q[0]);
  const L thrice_c1 = dot(start, q[0]) + dot(twice_middle, p[0]), thrice_c2 = dot(end, p[0]) + dot(twice_middle, q[0]);

  const L size = reach.x + reach.y + reach.z, volume = reach.x * reach.y * reach.z;
  const L underflow = kLaneUnderflow * (size + 1.0f);
  const L corner = kLaneCornerError * volume + underflow, middle = kLaneMiddleError * volume + underflow;
  const LaneMask<N> above = (c0 > corner) & (thrice_c1 > middle) & (thrice_c2 > middle) & (c3 > corner);
  const LaneMask<N> below = (c0 < -corner) & (thrice_c1 < -middle) & (thrice_c2 < -middle) & (c3 < -corner);
  return (above | below) & (size < L(kLaneMaxReach));
}

/// The gap along an axis: the axis separates during the whole motion where `gap` exceeds `error`.
template <int N>
struct LaneGap {
  Lanes<N> gap;           ///< The smaller of the projected gaps at both ends, times the axis' length.
  Lanes<N> error;         ///< Error bound of the gap.
  LaneVec<N> difference;  ///< Difference of the two points that the gap is between.

  /// The lanes that are certainly free.
  LaneMask<N> separates() const { return gap > error; }
};

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
