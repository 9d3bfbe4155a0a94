// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_lanes_gather.h"

/// What proves a motion free in lanes of float: for lane kernels only (math/lanes.h). docs/design/0005-lanes.md derives
/// the bounds; u = 2^-24.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// The error bound of a projected gap in units of (|w_x| M_x + |w_y| M_y + |w_z| M_z), M the reach: 10 u and terms of
/// second order are derived, the rest is margin for the rounding of the bound itself.
inline constexpr float kLaneGapError = 12 * 0x1p-24f;

/// The error bounds of the coplanarity cubic's coefficients in units of M_x M_y M_z: 48 u for the first and the last,
/// 174 u for three times the others.
inline constexpr float kLaneCornerError = 64 * 0x1p-24f;
inline constexpr float kLaneMiddleError = 224 * 0x1p-24f;

/// Stands for all products and sums that underflow, flushed to zero or not.
inline constexpr float kLaneUnderflow = 0x1p-110f;

/// The least reach: stands for coordinates that underflow on the way to float.
inline constexpr float kLaneMinReach = 0x1p-100f;

/// Where the coordinates of the reach add up to less, no product of three overflows.
inline constexpr float kLaneMaxReach = 0x1p40f;

template <int N>
LaneVec<N> select(LaneMask<N> mask, LaneVec<N> a, LaneVec<N> b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// The largest absolute value of each coordinate over all points and both ends, at least kLaneMinReach; infinite
/// where one is.
template <int N>
LaneVec<N> reach_of(const RelativePoints<N>& points) {
  const Lanes<N> least = kLaneMinReach;
  LaneVec<N> reach = {least, least, least};
  for (const auto& end : points.at)
    for (const LaneVec<N>& p : end) reach = {max(reach.x, abs(p.x)), max(reach.y, abs(p.y)), max(reach.z, abs(p.z))};
  return reach;
}

/// By how much a projected gap on `w` may be wrong; infinite or NaN where something overflows.
template <int N>
Lanes<N> gap_error(LaneVec<N> w, LaneVec<N> reach) {
  return kLaneGapError * (abs(w.x) * reach.x + abs(w.y) * reach.y + abs(w.z) * reach.z) + kLaneUnderflow;
}

/// True where the four points are certainly never in one plane, so that their features do not meet: the Bernstein
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

/// An axis looked at: the pair is apart along it during the whole motion where `gap` exceeds `error`.
template <int N>
struct LaneGap {
  Lanes<N> gap;           ///< The lesser of the projected gaps of both ends, times the axis' length.
  Lanes<N> error;         ///< It may be off by this much.
  LaneVec<N> difference;  ///< Of the two points that it is between.

  LaneMask<N> separates() const { return gap > error; }
};

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
