// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_lanes.h"

/// The separating-axis test of boxes in lanes: the same code on the CPU and on CUDA, where a lane is a thread. To be
/// included by kernels only.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// Cross products of edges that are nearer to parallel than this (squared sine) are not used as axes: rounding would
/// dominate them.
template <int kLanes>
constexpr float kMinCross = 0.01f;

/// Pairs of boxes, one a lane.
template <int kLanes>
struct BoxPairs {
  using F = Lanes<kLanes>;  ///< A number a lane.
  using V = Vec3T<F>;       ///< A vector a lane.

  V center_a;   ///< Centers of the boxes of A [mm].
  V center_b;   ///< Centers of the boxes of B [mm].
  V axes_a[3];  ///< Unit.
  V axes_b[3];  ///< Unit.
  F half_a[3];  ///< Half extents along axes_a [mm].
  F half_b[3];  ///< Half extents along axes_b [mm].

  /// Gathers the boxes of the queries; lanes past `count` repeat the last one.
  DISMANTLE_HOST_DEVICE BoxPairs(const BoxPairQuery* queries, std::size_t count) {
    constexpr int kFields = 24;
    float field[kFields][kLanes];
    for (int l = 0; l < kLanes; ++l) {
      const BoxPairQuery& q = queries[static_cast<std::size_t>(l) < count ? static_cast<std::size_t>(l) : count - 1];
      gather_box(field, 0, l, q.a->box);
      gather_box(field, 12, l, q.b->box);
    }
    center_a = load_vector(field, 0);
    center_b = load_vector(field, 12);
    for (int k = 0; k < 2; ++k) {
      axes_a[k] = load_vector(field, 3 + 3 * k);
      axes_b[k] = load_vector(field, 15 + 3 * k);
    }
    axes_a[2] = cross(axes_a[0], axes_a[1]);
    axes_b[2] = cross(axes_b[0], axes_b[1]);
    for (int k = 0; k < 3; ++k) {
      half_a[k] = F::load(field[9 + k]);
      half_b[k] = F::load(field[21 + k]);
    }
  }

 private:
  template <std::size_t kFields>
  DISMANTLE_HOST_DEVICE static void gather_box(float (&field)[kFields][kLanes], int first, int lane, const Obb& box) {
    const float* from = &box.center.x;  // 12 floats in a row
    for (int k = 0; k < 12; ++k) field[first + k][lane] = from[k];
  }
  template <std::size_t kFields>
  DISMANTLE_HOST_DEVICE static V load_vector(const float (&field)[kFields][kLanes], int first) {
    return {F::load(field[first]), F::load(field[first + 1]), F::load(field[first + 2])};
  }
};

/// The axis of the largest gap so far, with the boxes' rotation half way.
template <int kLanes>
struct FurthestAxes {
  using F = Lanes<kLanes>;  ///< A number a lane.
  using V = Vec3T<F>;       ///< A vector a lane.

  F gap = F(-3e38f);  ///< The largest so far [mm].
  V axis = {};        ///< Its axis.

  /// Takes the direction of `line` that separates the boxes if its gap is larger than all so far.
  /// @param offset_t0, offset_t1 from the center of B to that of A, along `line`, at the start and the end
  /// @param half sum of the two boxes' half extents along `line`
  /// @param scale 1 / |line|
  DISMANTLE_HOST_DEVICE void consider(V line, F offset_t0, F offset_t1, F half, F scale) {
    const F side = select(offset_t0 + offset_t1 > F(0), F(-1), F(1));
    const F nearest = min(-(side * offset_t0), -(side * offset_t1));
    const F found = (nearest - half) * scale;
    const auto better = found > gap;
    gap = select(better, found, gap);
    axis = select_vector<kLanes>(better, (side * scale) * line, axis);
  }
};

/// Relative positions of two boxes during the sweep.
template <int kLanes>
struct BoxMotion {
  using F = Lanes<kLanes>;  ///< A number a lane.
  using V = Vec3T<F>;       ///< A vector a lane.

  V offset_t0;     ///< From the center of B to that of A at the start [mm].
  V offset_t1;     ///< The same at the end [mm].
  V a[3];          ///< Axes of A with the rotation half way.
  F cosine[3][3];  ///< Absolute cosines between a[i] and the axes of B.

  /// Of these boxes in this sweep.
  DISMANTLE_HOST_DEVICE BoxMotion(const BoxPairs<kLanes>& boxes, const LinearSweep& sweep)
      : offset_t0(transformed<kLanes>(sweep.t0, boxes.center_a) - boxes.center_b),
        offset_t1(transformed<kLanes>(sweep.t1, boxes.center_a) - boxes.center_b) {
    for (int i = 0; i < 3; ++i) {
      a[i] = rotated<kLanes>(sweep.middle, boxes.axes_a[i]);
      for (int j = 0; j < 3; ++j) cosine[i][j] = abs(dot(a[i], boxes.axes_b[j]));
    }
  }
};

/// Considers all 15 axes of pairs of boxes.
template <int kLanes>
DISMANTLE_HOST_DEVICE void consider_all(const BoxPairs<kLanes>& boxes, const BoxMotion<kLanes>& motion,
                                        FurthestAxes<kLanes>& best) {
  using F = Lanes<kLanes>;
  using V = Vec3T<F>;
  for (int i = 0; i < 3; ++i) {
    const F reach_b = boxes.half_b[0] * motion.cosine[i][0] + boxes.half_b[1] * motion.cosine[i][1] +
                      boxes.half_b[2] * motion.cosine[i][2];
    best.consider(motion.a[i], dot(motion.a[i], motion.offset_t0), dot(motion.a[i], motion.offset_t1),
                  boxes.half_a[i] + reach_b, F(1));
    const F reach_a = boxes.half_a[0] * motion.cosine[0][i] + boxes.half_a[1] * motion.cosine[1][i] +
                      boxes.half_a[2] * motion.cosine[2][i];
    const V b = boxes.axes_b[i];
    best.consider(b, dot(b, motion.offset_t0), dot(b, motion.offset_t1), boxes.half_b[i] + reach_a, F(1));
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const V line = cross(motion.a[i], boxes.axes_b[j]);
      const F square = dot(line, line);
      const auto parallel = square < F(kMinCross<kLanes>);
      const F scale = F(1) / sqrt(select(parallel, F(1), square));
      const F half = boxes.half_a[i1] * motion.cosine[i2][j] + boxes.half_a[i2] * motion.cosine[i1][j] +
                     boxes.half_b[j1] * motion.cosine[i][j2] + boxes.half_b[j2] * motion.cosine[i][j1];
      best.consider(line, dot(line, motion.offset_t0), dot(line, motion.offset_t1),
                    half + select(parallel, F(1e30f), F(0)), scale);
    }
  }
}

/// Body of separate_boxes_kernel().
template <int kLanes>
DISMANTLE_HOST_DEVICE void separate_box_lanes(const BoxPairQuery* queries, std::size_t count, const LinearSweep& sweep,
                                              NodeSeparation* separations) {
  using F = Lanes<kLanes>;
  using V = Vec3T<F>;
  for (std::size_t first = 0; first < count; first += kLanes) {
    const std::size_t left = count - first;
    const BoxPairs<kLanes> boxes(queries + first, left);
    const BoxMotion<kLanes> motion(boxes, sweep);
    FurthestAxes<kLanes> furthest;
    consider_all<kLanes>(boxes, motion, furthest);
    const V axis = furthest.axis;
    const Hulls<kLanes> hull{
        boxes.center_a,
        {boxes.half_a[0] * boxes.axes_a[0], boxes.half_a[1] * boxes.axes_a[1], boxes.half_a[2] * boxes.axes_a[2]},
        F(0)};
    F reach_b(0);
    for (int k = 0; k < 3; ++k) reach_b = reach_b + abs(dot(axis, boxes.axes_b[k])) * boxes.half_b[k];
    const F offset = dot(axis, boxes.center_b) - reach_b;
    store_separations<kLanes>(axis, offset, hull, sweep, separations + first, left);
  }
}

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
