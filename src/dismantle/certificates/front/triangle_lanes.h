// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_lanes.h"

/// The separating-axis test of triangles in lanes: the same code on the CPU and on CUDA, where a lane is a thread. To
/// be included by kernels only.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// Cross products with a smaller squared length [mm^4] are not used as axes.
template <int kLanes>
constexpr float kNoAxis = 1e-30f;

/// Pairs of triangles, one a lane.
template <int kLanes>
struct TrianglePairs {
  using F = Lanes<kLanes>;  ///< A number a lane.
  using V = Vec3T<F>;       ///< A vector a lane.

  V a[3];  ///< Corners of A [mm].
  V b[3];  ///< Corners of B [mm].

  /// Gathers the corners of the queries; lanes past `count` repeat the last one.
  DISMANTLE_HOST_DEVICE TrianglePairs(const TrianglePairQuery* queries, std::size_t count) {
    constexpr int kFields = 18;
    float field[kFields][kLanes];
    for (int l = 0; l < kLanes; ++l) {
      const TrianglePairQuery& q =
          queries[static_cast<std::size_t>(l) < count ? static_cast<std::size_t>(l) : count - 1];
      const float *from_a = &q.a->corner[0].x, *from_b = &q.b->corner[0].x;  // 9 floats in a row each
      for (int k = 0; k < 9; ++k) field[k][l] = from_a[k];
      for (int k = 0; k < 9; ++k) field[9 + k][l] = from_b[k];
    }
    const auto vector = [&](int first) {
      return V{F::load(field[first]), F::load(field[first + 1]), F::load(field[first + 2])};
    };
    for (int k = 0; k < 3; ++k) {
      a[k] = vector(3 * k);
      b[k] = vector(9 + 3 * k);
    }
  }
};

/// The vector scaled to unit length; zero if it is shorter than kNoAxis.
template <int kLanes>
DISMANTLE_HOST_DEVICE Vec3T<Lanes<kLanes>> unit_or_zero(Vec3T<Lanes<kLanes>> v) {
  using F = Lanes<kLanes>;
  const F square = dot(v, v);
  const auto none = square < F(kNoAxis<kLanes>);
  return select(none, F(0), F(1) / sqrt(select(none, F(1), square))) * v;
}

/// The axes of two triangles: both normals, the perpendiculars of the edges in their planes, and the cross products of
/// the edges.
template <int kLanes>
struct TriangleAxes {
  using F = Lanes<kLanes>;  ///< A number a lane.
  using V = Vec3T<F>;       ///< A vector a lane.

  V at_t0[3];         ///< Corners of A at the start, in B's frame [mm].
  V at_t1[3];         ///< The same at the end [mm].
  V b[3];             ///< Corners of B [mm].
  F gap = F(-3e38f);  ///< The largest gap so far [mm].
  V axis = {};        ///< Its axis.

  /// Considers both directions of a line.
  DISMANTLE_HOST_DEVICE void consider(V line) {
    const V w = unit_or_zero<kLanes>(line);
    F low_a(3e38f), high_a(-3e38f), low_b(3e38f), high_b(-3e38f);
    for (int k = 0; k < 3; ++k) {
      const F x0 = dot(w, at_t0[k]), x1 = dot(w, at_t1[k]), y = dot(w, b[k]);
      low_a = min(low_a, min(x0, x1));
      high_a = max(high_a, max(x0, x1));
      low_b = min(low_b, y);
      high_b = max(high_b, y);
    }
    // A zero axis would find no gap and no overlap.
    const F none = select(dot(w, w) < F(0.5f), F(1e30f), F(0));
    consider_side(w, low_b - high_a - none);
    consider_side(-w, low_a - high_b - none);
  }

 private:
  DISMANTLE_HOST_DEVICE void consider_side(V w, F found) {
    const auto better = found > gap;
    gap = select(better, found, gap);
    axis = select_vector<kLanes>(better, w, axis);
  }
};

/// Body of separate_triangles_kernel().
template <int kLanes>
DISMANTLE_HOST_DEVICE void separate_triangle_lanes(const TrianglePairQuery* queries, std::size_t count,
                                                   const LinearSweep& sweep, NodeSeparation* separations) {
  using F = Lanes<kLanes>;
  using V = Vec3T<F>;
  for (std::size_t first = 0; first < count; first += kLanes) {
    const std::size_t left = count - first;
    const TrianglePairs<kLanes> pairs(queries + first, left);
    const Hulls<kLanes> hull{
        pairs.a[0], {pairs.a[1] - pairs.a[0], pairs.a[2] - pairs.a[0], V{}}, F(NodeHull::kTriangle)};
    const V along_a[3] = {rotated<kLanes>(sweep.middle, hull.span[0]),
                          rotated<kLanes>(sweep.middle, pairs.a[2] - pairs.a[1]),
                          rotated<kLanes>(sweep.middle, hull.span[1])};
    const V along_b[3] = {pairs.b[1] - pairs.b[0], pairs.b[2] - pairs.b[1], pairs.b[2] - pairs.b[0]};
    const V normal_a = cross(along_a[0], along_a[2]), normal_b = cross(along_b[0], along_b[2]);
    TriangleAxes<kLanes> axes{{}, {}, {pairs.b[0], pairs.b[1], pairs.b[2]}};
    for (int k = 0; k < 3; ++k) {
      axes.at_t0[k] = transformed<kLanes>(sweep.t0, pairs.a[k]);
      axes.at_t1[k] = transformed<kLanes>(sweep.t1, pairs.a[k]);
    }
    axes.consider(normal_a);
    axes.consider(normal_b);
    for (int i = 0; i < 3; ++i) {
      axes.consider(cross(along_a[i], normal_a));
      axes.consider(cross(along_b[i], normal_b));
      for (int j = 0; j < 3; ++j) axes.consider(cross(along_a[i], along_b[j]));
    }
    F min_b(3e38f);
    for (int k = 0; k < 3; ++k) min_b = min(min_b, dot(axes.axis, pairs.b[k]));
    store_separations<kLanes>(axes.axis, min_b, hull, sweep, separations + first, left);
  }
}

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
