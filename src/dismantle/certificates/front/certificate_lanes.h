// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"
#include "dismantle/math/lanes.h"

/// Certificates in lanes, and the choice of their axes: shared by the front's kernels. To be included by kernels only.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

///@{ The constants of OutwardNormals in float32.
template <int kLanes>
constexpr float kMinCosine = -0.05f;
template <int kLanes>
constexpr float kMinAgainst = 0.3f;
template <int kLanes>
constexpr float kBehind = 4;
///@}

/// The vector in every lane.
template <int kLanes>
DISMANTLE_HOST_DEVICE Vec3T<Lanes<kLanes>> uniform(const Vec3f& v) {
  return {v.x, v.y, v.z};
}

/// The vector turned by a rotation matrix.
template <int kLanes>
DISMANTLE_HOST_DEVICE Vec3T<Lanes<kLanes>> rotated(const Vec3f (&row)[3], Vec3T<Lanes<kLanes>> v) {
  return {dot(uniform<kLanes>(row[0]), v), dot(uniform<kLanes>(row[1]), v), dot(uniform<kLanes>(row[2]), v)};
}

/// The point moved by a rigid transform.
template <int kLanes>
DISMANTLE_HOST_DEVICE Vec3T<Lanes<kLanes>> transformed(const RigidTransformF& t, Vec3T<Lanes<kLanes>> p) {
  return rotated<kLanes>(t.row, p) + uniform<kLanes>(t.translation);
}

/// Lanes of `yes` where `mask` is set, else of `no`.
template <int kLanes, class Mask>
DISMANTLE_HOST_DEVICE Vec3T<Lanes<kLanes>> select_vector(Mask mask, const Vec3T<Lanes<kLanes>>& yes,
                                                         const Vec3T<Lanes<kLanes>>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

/// Stores a vector to three rows.
template <std::size_t kFields, int kLanes>
DISMANTLE_HOST_DEVICE void store_vector(float (&field)[kFields][kLanes], int first, const Vec3T<Lanes<kLanes>>& v) {
  v.x.store(field[first]);
  v.y.store(field[first + 1]);
  v.z.store(field[first + 2]);
}

/// The vector of one lane from three rows.
template <std::size_t kFields, int kLanes>
DISMANTLE_HOST_DEVICE Vec3f lane_vector(const float (&field)[kFields][kLanes], int first, std::size_t lane) {
  return {field[first][lane], field[first + 1][lane], field[first + 2][lane]};
}

/// NodeHull in lanes, one hull a lane.
template <int kLanes>
struct Hulls {
  Vec3T<Lanes<kLanes>> center;   ///< As NodeHull::center.
  Vec3T<Lanes<kLanes>> span[3];  ///< As NodeHull::span.
  Lanes<kLanes> kind;            ///< As NodeHull::kind.
};

/// The extent of hulls along an axis, with A at pose `t`.
template <int kLanes>
DISMANTLE_HOST_DEVICE Lanes<kLanes> reach_along(Vec3T<Lanes<kLanes>> axis, const Hulls<kLanes>& hull,
                                                const RigidTransformF& t) {
  using F = Lanes<kLanes>;
  using V = Vec3T<F>;
  const V w =
      axis.x * uniform<kLanes>(t.row[0]) + axis.y * uniform<kLanes>(t.row[1]) + axis.z * uniform<kLanes>(t.row[2]);
  const F s0 = dot(w, hull.span[0]), s1 = dot(w, hull.span[1]), s2 = dot(w, hull.span[2]);
  const F of_box = abs(s0) + abs(s1) + abs(s2), of_triangle = max(F(0), max(s0, s1));
  return (dot(axis, uniform<kLanes>(t.translation)) + dot(w, hull.center)) +
         select(hull.kind > F(0), of_triangle, of_box);
}

/// The smallest gap of certificates during the sweep.
template <int kLanes>
DISMANTLE_HOST_DEVICE Lanes<kLanes> min_gap(Vec3T<Lanes<kLanes>> axis, Lanes<kLanes> offset, const Hulls<kLanes>& hull,
                                            const LinearSweep& sweep) {
  return offset - max(reach_along<kLanes>(axis, hull, sweep.t0), reach_along<kLanes>(axis, hull, sweep.t1));
}

/// The smallest gaps of certificates i, i + 1, ... @param kind receives NodeHull::kind of each
template <int kLanes>
DISMANTLE_HOST_DEVICE Lanes<kLanes> min_gaps(const CertificateBlocks& c, std::size_t i, const LinearSweep& sweep,
                                             Lanes<kLanes>& kind) {
  using F = Lanes<kLanes>;
  const float* from = c.data +
                      (i / CertificateBlocks::kBlock * CertificateBlocks::kFields) * CertificateBlocks::kBlock +
                      i % CertificateBlocks::kBlock;
  const auto field = [&](std::size_t k) { return F::load(from + k * CertificateBlocks::kBlock); };
  const auto vector = [&](std::size_t k) { return Vec3T<F>{field(k), field(k + 1), field(k + 2)}; };
  const Hulls<kLanes> hull{vector(4), {vector(7), vector(10), vector(13)}, field(16)};
  kind = hull.kind;
  return min_gap<kLanes>(vector(0), field(3), hull, sweep);
}

/// Mask of the certificates with these smallest gaps that certify their pairs. Those on edge are not accepted while
/// they use the allowance: the pair may be apart along another axis by now.
template <int kLanes>
DISMANTLE_HOST_DEVICE auto certify(Lanes<kLanes> gap, Lanes<kLanes> kind, const LinearSweep& sweep) {
  using F = Lanes<kLanes>;
  return gap >= select(kind == F(NodeHull::kTriangleOnEdge), F(sweep.meeting), F(sweep.limit));
}

/// Decides by outward normals (cones of nodes, or the normals of two triangles) which axes may use the allowance.
template <int kLanes>
struct FacingLanes {
  using F = Lanes<kLanes>;  ///< A number a lane.
  using V = Vec3T<F>;       ///< A vector a lane.

  V normal_a;  ///< Of A, with the rotation half way.
  V normal_b;  ///< Of B.
  F ahead_a;   ///< Smallest cosine of normal_a with an axis that may use the allowance.
  F ahead_b;   ///< The same of normal_b.
  F allowed;   ///< [mm]

  /// The amount to subtract from a gap along `w`: nothing if every normal agrees, more than the allowance if the axis
  /// separates the two behind each other's backs (OutwardNormals).
  DISMANTLE_HOST_DEVICE F taken_off(V w) const {
    const F along_a = dot(w, normal_a), along_b = -dot(w, normal_b);
    const auto against = (along_a < F(-kMinAgainst<kLanes>)) & (along_b < F(-kMinAgainst<kLanes>));
    const auto faces = (along_a >= ahead_a) & (along_b >= ahead_b);
    return select(faces, F(0), select(against, F(kBehind<kLanes>), F(1)) * allowed);
  }
};

/// The axis of the largest gap so far, minus what FacingLanes subtracts.
template <int kLanes>
struct FacingAxes {
  using F = Lanes<kLanes>;  ///< A number a lane.
  using V = Vec3T<F>;       ///< A vector a lane.

  const FacingLanes<kLanes>& facing;  ///< Decides which axes may use the allowance.
  V guard;                            ///< As BoxPairQuery::guard.
  F apart;                            ///< As LinearSweep::apart [mm].
  F gap = F(-3e38f);                  ///< The largest so far [mm].
  V axis = {};                        ///< Its axis.

  /// Takes the unit axis `w` if its gap `found`, less what is to be subtracted, is larger than all so far.
  DISMANTLE_HOST_DEVICE void consider_side(V w, F found) {
    const F counts = found - facing.taken_off(w);
    const auto better = (counts > gap) & !((dot(w, guard) < F(0)) & (found < apart));
    gap = select(better, counts, gap);
    axis = select_vector<kLanes>(better, w, axis);
  }

  /// As FurthestAxes::consider(), for both directions of the line.
  DISMANTLE_HOST_DEVICE void consider(V line, F offset_t0, F offset_t1, F half, F scale) {
    const V w = scale * line;
    consider_side(w, (-max(offset_t0, offset_t1) - half) * scale);
    consider_side(-w, (min(offset_t0, offset_t1) - half) * scale);
  }
};

/// Stores the separations of up to kLanes pairs of nodes or triangles. Axes on the wrong side of the guard, and zero
/// axes, get no gap.
/// @param count of the pairs; lanes past it are padding
template <int kLanes>
DISMANTLE_HOST_DEVICE void store_separations(Vec3T<Lanes<kLanes>> axis, Lanes<kLanes> offset, const Hulls<kLanes>& hull,
                                             Vec3T<Lanes<kLanes>> guard, const LinearSweep& sweep, NodeSeparation* to,
                                             std::size_t count) {
  using F = Lanes<kLanes>;
  F gap = min_gap<kLanes>(axis, offset, hull, sweep);
  const auto wrong_side = (dot(axis, guard) < F(0)) & (gap < F(sweep.apart));
  const auto none = dot(axis, axis) < F(0.5f);
  gap = select(wrong_side | none, F(-3e38f), gap);
  float lane[CertificateBlocks::kFields][kLanes], gaps[kLanes];
  store_vector(lane, 0, axis);
  offset.store(lane[3]);
  store_vector(lane, 4, hull.center);
  for (int k = 0; k < 3; ++k) store_vector(lane, 7 + 3 * k, hull.span[k]);
  hull.kind.store(lane[16]);
  gap.store(gaps);
  for (std::size_t l = 0; l < kLanes && l < count; ++l) {
    NodeSeparation& s = to[l];
    s.gap = gaps[l];
    s.certificate.axis = lane_vector(lane, 0, l);
    s.certificate.offset = lane[3][l];
    s.certificate.hull.center = lane_vector(lane, 4, l);
    for (int k = 0; k < 3; ++k) s.certificate.hull.span[k] = lane_vector(lane, 7 + 3 * k, l);
    s.certificate.hull.kind = lane[16][l];
  }
}

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
