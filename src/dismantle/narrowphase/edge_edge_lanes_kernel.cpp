// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/ccd_lanes_search.h"

namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// An edge from the origin to the first point and one from the second to the third, for undecided_motions().
struct EdgeEdgeLanes {
  using Rows = EdgeEdgeRows;

  /// The axis between the closest points of the edges halfway through the motion (Ericson, Real-Time Collision
  /// Detection, 5.1.9, with one more projection in place of its cases).
  template <int N>
  static LaneVec<N> guess(const RelativePoints<N>& points) {
    using L = Lanes<N>;
    const LaneVec<N> a = points.at[0][0] + points.at[1][0], b0 = points.at[0][1] + points.at[1][1];
    const LaneVec<N> b = points.at[0][2] + points.at[1][2] - b0;
    const L aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), a_b0 = dot(a, b0), b_b0 = dot(b, b0);
    const L inverse_aa = 1.0f / aa, inverse_bb = 1.0f / bb;
    const L first = clamped((bb * a_b0 - ab * b_b0) / (aa * bb - ab * ab));
    const L along_b = clamped((ab * first - b_b0) * inverse_bb);
    const L along_a = clamped((ab * along_b + a_b0) * inverse_aa);
    return b0 + along_b * b - along_a * a;
  }

  template <int N>
  static LaneGap<N> gap(const RelativePoints<N>& points, LaneVec<N> axis, LaneVec<N> reach) {
    const LaneGap<N> start = gap_at(points.at[0], axis), end = gap_at(points.at[1], axis);
    const LaneMask<N> at_start = start.gap < end.gap;
    return {min(start.gap, end.gap), gap_error(axis, reach), select(at_start, start.difference, end.difference)};
  }

 private:
  /// `x` clamped to [0, 1]; 0 for NaN, which parallel and zero-length edges give.
  template <int N>
  static Lanes<N> clamped(Lanes<N> x) {
    return min(max(x, Lanes<N>(0)), Lanes<N>(1));
  }

  template <int N>
  static LaneGap<N> gap_at(const LaneVec<N> (&points)[3], LaneVec<N> axis) {
    const Lanes<N> a = dot(axis, points[0]), b0 = dot(axis, points[1]), b1 = dot(axis, points[2]), zero = 0;
    const LaneVec<N> nearest_b = select(b0 < b1, points[1], points[2]),
                     nearest_a = select(zero < a, points[0], LaneVec<N>{});
    return {min(b0, b1) - max(a, zero), zero, nearest_b - nearest_a};
  }
};

}  // namespace DISMANTLE_LANES_ISA

template <>
std::uint32_t edge_edge_lanes_kernel<DISMANTLE_LANE_COUNT>(const double* motions, std::uint32_t count,
                                                           std::uint32_t next, std::uint32_t* undecided) {
  return undecided_motions<DISMANTLE_LANE_COUNT, EdgeEdgeLanes>(motions, count, next, undecided);
}

}  // namespace dismantle
