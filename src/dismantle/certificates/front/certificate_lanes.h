// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"
#include "dismantle/math/lanes.h"

/// Certificates in lanes: shared by the front's kernels. To be included by kernels only.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

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

/// The smallest gaps of certificates i, i + 1, ...
template <int kLanes>
DISMANTLE_HOST_DEVICE Lanes<kLanes> min_gaps(const CertificateBlocks& c, std::size_t i, const LinearSweep& sweep) {
  using F = Lanes<kLanes>;
  const float* from = c.data +
                      (i / CertificateBlocks::kBlock * CertificateBlocks::kFields) * CertificateBlocks::kBlock +
                      i % CertificateBlocks::kBlock;
  const auto field = [&](std::size_t k) { return F::load(from + k * CertificateBlocks::kBlock); };
  const auto vector = [&](std::size_t k) { return Vec3T<F>{field(k), field(k + 1), field(k + 2)}; };
  const Hulls<kLanes> hull{vector(4), {vector(7), vector(10), vector(13)}, field(16)};
  return min_gap<kLanes>(vector(0), field(3), hull, sweep);
}

/// Stores the separations of up to kLanes pairs of nodes or triangles. Zero axes get no gap.
/// @param count of the pairs; lanes past it are padding
template <int kLanes>
DISMANTLE_HOST_DEVICE void store_separations(Vec3T<Lanes<kLanes>> axis, Lanes<kLanes> offset, const Hulls<kLanes>& hull,
                                             const LinearSweep& sweep, NodeSeparation* to, std::size_t count) {
  using F = Lanes<kLanes>;
  F gap = min_gap<kLanes>(axis, offset, hull, sweep);
  gap = select(dot(axis, axis) < F(0.5f), F(-3e38f), gap);
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
