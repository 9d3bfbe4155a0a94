// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/ccd_lanes_search.h"

namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// A vertex at the origin and a face, for undecided_motions().
struct VertexFaceLanes {
  using Rows = VertexFaceRows;

  /// The axis from the vertex to the closest point of the face halfway through the motion, twice as long (Ericson,
  /// Real-Time Collision Detection, 5.1.5).
  template <int N>
  static LaneVec<N> guess(const RelativePoints<N>& points) {
    using L = Lanes<N>;
    const LaneVec<N> a = points.at[0][0] + points.at[1][0], b = points.at[0][1] + points.at[1][1];
    const LaneVec<N> c = points.at[0][2] + points.at[1][2];
    const LaneVec<N> ab = b - a, ac = c - a;
    const L d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b), d5 = -dot(ab, c), d6 = -dot(ac, c);
    const L va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    const L along = d4 - d3, back = d5 - d6, zero = 0, one = 1;

    // The weights of the second and third corner, and the sum of all three; later lines take precedence.
    L weight_b = vb, weight_c = vc, sum = va + vb + vc;
    const auto take = [&](LaneMask<N> where, L for_b, L for_c, L for_all) {
      weight_b = select(where, for_b, weight_b);
      weight_c = select(where, for_c, weight_c);
      sum = select(where, for_all, sum);
    };
    take((va <= zero) & (along >= zero) & (back >= zero), back, along, along + back);
    take((vb <= zero) & (d2 >= zero) & (d6 <= zero), zero, d2, d2 - d6);
    take((vc <= zero) & (d1 >= zero) & (d3 <= zero), d1, zero, d1 - d3);
    take((d6 >= zero) & (d5 <= d6), zero, one, one);
    take((d3 >= zero) & (d4 <= d3), one, zero, one);
    take((d1 <= zero) & (d2 <= zero), zero, zero, one);
    const L scale = one / sum;
    return a + (weight_b * scale) * ab + (weight_c * scale) * ac;
  }

  template <int N>
  static LaneGap<N> gap(const RelativePoints<N>& points, LaneVec<N> axis, LaneVec<N> reach) {
    LaneGap<N> found;
    found.difference = points.at[0][0];
    found.gap = dot(axis, found.difference);
    for (int k = 1; k < 6; ++k) {
      const LaneVec<N>& corner = points.at[k / 3][k % 3];
      const Lanes<N> projected = dot(axis, corner);
      found.difference = select(projected < found.gap, corner, found.difference);
      found.gap = min(projected, found.gap);
    }
    found.error = gap_error(axis, reach);
    return found;
  }
};

}  // namespace DISMANTLE_LANES_ISA

template <>
std::uint32_t vertex_face_lanes_kernel<DISMANTLE_LANE_COUNT>(const double* motions, std::uint32_t count,
                                                             std::uint32_t next, std::uint32_t* undecided) {
  return undecided_motions<DISMANTLE_LANE_COUNT, VertexFaceLanes>(motions, count, next, undecided);
}

}  // namespace dismantle
