// SPDX-License-Identifier: Apache-2.0
#include "dismantle/front/certificate_kernels.h"

#include "dismantle/math/lanes.h"

namespace dismantle {

inline namespace DISMANTLE_LANES_ISA {

/// Crosses of edges that are nearer to parallel than this (squared sine) are no axes: rounding would swallow them.
template <int kLanes>
constexpr float kLeastCross = 0.01f;

template <int kLanes>
Vec3T<Lanes<kLanes>> uniform(const Vec3f& v) {
  return {v.x, v.y, v.z};
}

template <int kLanes>
Vec3T<Lanes<kLanes>> rotated(const Vec3f (&row)[3], Vec3T<Lanes<kLanes>> v) {
  return {dot(uniform<kLanes>(row[0]), v), dot(uniform<kLanes>(row[1]), v), dot(uniform<kLanes>(row[2]), v)};
}

template <int kLanes>
Vec3T<Lanes<kLanes>> transformed(const RigidTransformF& t, Vec3T<Lanes<kLanes>> p) {
  return rotated<kLanes>(t.row, p) + uniform<kLanes>(t.translation);
}

/// Pairs of boxes, one a lane.
template <int kLanes>
struct BoxPairs {
  using F = Lanes<kLanes>;
  using V = Vec3T<F>;

  V center_a, center_b, axes_a[3], axes_b[3];
  F half_a[3], half_b[3], radius_a;
  V guard;

  /// Gathers from the nodes; lanes past `count` repeat the last pair.
  BoxPairs(const BoxPairQuery* queries, std::size_t count) {
    constexpr int kFields = 28;
    float field[kFields][kLanes];
    for (int l = 0; l < kLanes; ++l) {
      const BoxPairQuery& q = queries[static_cast<std::size_t>(l) < count ? static_cast<std::size_t>(l) : count - 1];
      gather_box(field, 0, l, q.a->box);
      gather_box(field, 12, l, q.b->box);
      field[24][l] = q.a->radius;
      field[25][l] = q.guard.x;
      field[26][l] = q.guard.y;
      field[27][l] = q.guard.z;
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
    radius_a = F::load(field[24]);
    guard = load_vector(field, 25);
  }

 private:
  template <std::size_t kFields>
  static void gather_box(float (&field)[kFields][kLanes], int first, int lane, const Obb& box) {
    const float* from = &box.center.x;  // 12 floats in a row
    for (int k = 0; k < 12; ++k) field[first + k][lane] = from[k];
  }
  template <std::size_t kFields>
  static V load_vector(const float (&field)[kFields][kLanes], int first) {
    return {F::load(field[first]), F::load(field[first + 1]), F::load(field[first + 2])};
  }
};

/// The axis of the largest gap so far.
template <int kLanes>
struct FurthestAxes {
  using F = Lanes<kLanes>;
  using V = Vec3T<F>;

  V guard;
  F error, apart, turned;
  F gap = F(-3e38f), support = F(0);
  V axis = {};

  /// @param way_t0, way_t1 from the center of B to that of A, along `line`, at either end
  /// @param half the two boxes' extents along `line`
  /// @param scale 1 / |line|
  void consider(V line, F way_t0, F way_t1, F half, F scale) {
    const F side = select(way_t0 + way_t1 > F(0), F(-1), F(1));
    const F nearest = min(-(side * way_t0), -(side * way_t1));
    const F along = side * dot(line, guard);
    const F found = (nearest - half - error) * scale - turned;
    const auto better = (found > gap) & !((along < F(0)) & (found < apart));
    gap = select(better, found, gap);
    support = select(better, (half + error) * scale, support);
    const F factor = side * scale;
    axis.x = select(better, factor * line.x, axis.x);
    axis.y = select(better, factor * line.y, axis.y);
    axis.z = select(better, factor * line.z, axis.z);
  }
};

/// All 15 axes of pairs of boxes.
template <int kLanes>
FurthestAxes<kLanes> furthest_axes(const BoxPairs<kLanes>& boxes, const PairSweep& sweep) {
  using F = Lanes<kLanes>;
  using V = Vec3T<F>;
  const V way_t0 = transformed<kLanes>(sweep.t0, boxes.center_a) - boxes.center_b;
  const V way_t1 = transformed<kLanes>(sweep.t1, boxes.center_a) - boxes.center_b;
  V a[3];
  F cosine[3][3];
  for (int i = 0; i < 3; ++i) {
    a[i] = rotated<kLanes>(sweep.middle, boxes.axes_a[i]);
    for (int j = 0; j < 3; ++j) cosine[i][j] = abs(dot(a[i], boxes.axes_b[j]));
  }

  FurthestAxes<kLanes> best{boxes.guard, F(sweep.error), F(sweep.apart), F(sweep.turn) * boxes.radius_a};
  for (int i = 0; i < 3; ++i) {
    const F reach_b = boxes.half_b[0] * cosine[i][0] + boxes.half_b[1] * cosine[i][1] + boxes.half_b[2] * cosine[i][2];
    best.consider(a[i], dot(a[i], way_t0), dot(a[i], way_t1), boxes.half_a[i] + reach_b, F(1));
    const F reach_a = boxes.half_a[0] * cosine[0][i] + boxes.half_a[1] * cosine[1][i] + boxes.half_a[2] * cosine[2][i];
    const V b = boxes.axes_b[i];
    best.consider(b, dot(b, way_t0), dot(b, way_t1), boxes.half_b[i] + reach_a, F(1));
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const V line = cross(a[i], boxes.axes_b[j]);
      const F square = dot(line, line);
      const auto parallel = square < F(kLeastCross<kLanes>);
      const F scale = F(1) / sqrt(select(parallel, F(1), square));
      const F half = boxes.half_a[i1] * cosine[i2][j] + boxes.half_a[i2] * cosine[i1][j] +
                     boxes.half_b[j1] * cosine[i][j2] + boxes.half_b[j2] * cosine[i][j1];
      best.consider(line, dot(line, way_t0), dot(line, way_t1), half + select(parallel, F(1e30f), F(0)), scale);
    }
  }
  return best;
}

/// The change of rotation since each certificate was made, by its epoch; huge where that is forgotten.
template <int kLanes>
Lanes<kLanes> turn_since(Lanes<kLanes> epoch, const PairSweep& sweep, const float* turns) {
  using F = Lanes<kLanes>;
  F turn(1e18f);
  const unsigned kept = sweep.epoch < PairSweep::kEpochs ? sweep.epoch + 1 : PairSweep::kEpochs;
  for (unsigned k = 0; k < kept; ++k) {
    const unsigned number = sweep.epoch - k;
    turn = select(epoch == F(static_cast<float>(number)), F(turns[number % PairSweep::kEpochs]), turn);
  }
  return turn;
}

/// The least gaps of certificates i, i + 1, ...
template <int kLanes>
Lanes<kLanes> least_gaps(const CertificateArrays& c, std::size_t i, const PairSweep& sweep) {
  using F = Lanes<kLanes>;
  using V = Vec3T<F>;
  const V axis{F::load(c.axis[0] + i), F::load(c.axis[1] + i), F::load(c.axis[2] + i)};
  const V point{F::load(c.point[0] + i), F::load(c.point[1] + i), F::load(c.point[2] + i)};
  const F offset = F::load(c.offset + i), radius = F::load(c.radius + i), epoch = F::load(c.epoch + i);
  const F t0 =
      dot(axis, transformed<kLanes>(sweep.t0, point)) + turn_since<kLanes>(epoch, sweep, sweep.turn_t0) * radius;
  const F t1 =
      dot(axis, transformed<kLanes>(sweep.t1, point)) + turn_since<kLanes>(epoch, sweep, sweep.turn_t1) * radius;
  return offset - max(t0, t1);
}

}  // namespace DISMANTLE_LANES_ISA

template <>
CertificateCheck check_certificates_kernel<DISMANTLE_LANE_COUNT>(const CertificateArrays& certificates,
                                                                 std::size_t count, const PairSweep& sweep,
                                                                 std::uint32_t* failing) {
  constexpr int kLanes = DISMANTLE_LANE_COUNT;
  using F = Lanes<kLanes>;
  std::size_t found = 0;
  F least(3e38f);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const F gaps = least_gaps<kLanes>(certificates, i, sweep);
    const auto holds = gaps >= F(sweep.limit);
    const unsigned past = count - i < kLanes ? ~0u << (count - i) : 0u;  // lanes of the padding
    unsigned failed = bits(!holds) & ~past;
    if (past == 0) {
      least = min(least, select(holds, gaps, F(3e38f)));
    } else {
      float gap[kLanes];
      gaps.store(gap);
      for (std::size_t l = 0; l < count - i; ++l)
        if (gap[l] >= sweep.limit) least = min(least, F(gap[l]));
    }
    for (; failed != 0; failed &= failed - 1)
      failing[found++] = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(__builtin_ctz(failed));
  }
  float gap[kLanes];
  least.store(gap);
  CertificateCheck check;
  check.failing = found;
  for (int l = 0; l < kLanes; ++l) check.least_gap = gap[l] < check.least_gap ? gap[l] : check.least_gap;
  return check;
}

template <>
void separate_boxes_kernel<DISMANTLE_LANE_COUNT>(const BoxPairQuery* queries, std::size_t count, const PairSweep& sweep,
                                                 BoxSeparation* separations) {
  constexpr int kLanes = DISMANTLE_LANE_COUNT;
  for (std::size_t first = 0; first < count; first += kLanes) {
    const std::size_t left = count - first;
    const BoxPairs<kLanes> boxes(queries + first, left);
    const FurthestAxes<kLanes> best = furthest_axes<kLanes>(boxes, sweep);
    float gap[kLanes], x[kLanes], y[kLanes], z[kLanes], offset[kLanes];
    best.gap.store(gap);
    best.axis.x.store(x);
    best.axis.y.store(y);
    best.axis.z.store(z);
    (dot(best.axis, boxes.center_b) - best.support).store(offset);
    for (std::size_t l = 0; l < kLanes && l < left; ++l) {
      BoxSeparation& s = separations[first + l];
      const ObbNode& a = *queries[first + l].a;
      s.gap = gap[l];
      s.certificate.axis.x = x[l];
      s.certificate.axis.y = y[l];
      s.certificate.axis.z = z[l];
      s.certificate.point.x = a.box.center.x;
      s.certificate.point.y = a.box.center.y;
      s.certificate.point.z = a.box.center.z;
      s.certificate.offset = offset[l];
      s.certificate.radius = a.radius;
      s.certificate.epoch = sweep.epoch;
    }
  }
}

}  // namespace dismantle
