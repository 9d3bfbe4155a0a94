// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_result.h"

#include <algorithm>
#include <cmath>
#include <vector>

/// Brute-force results for moving triangles, in long double, sharing no code with the tested functions.
namespace dismantle::oracle {

using Real = long double;
using Vec = Vec3T<Real>;

struct Corners {
  Vec corner[3];
};

inline Vec widened(Vec3 v) {
  return {v.x, v.y, v.z};
}

/// The triangle at time s of its linear vertex paths.
inline Corners at(const TriangleMotion& m, Real s) {
  Corners c;
  for (int i = 0; i < 3; ++i) c.corner[i] = (1 - s) * widened(m.t0[i]) + s * widened(m.t1[i]);
  return c;
}

/// The gap of two triangles along the best of the 17 candidate axes: about their distance if it is attained on a face
/// or an edge, minus their depth if they intersect.
inline Real best_gap(const Corners& a, const Corners& b) {
  std::vector<Vec> axes;
  const Vec na = cross(a.corner[1] - a.corner[0], a.corner[2] - a.corner[0]);
  const Vec nb = cross(b.corner[1] - b.corner[0], b.corner[2] - b.corner[0]);
  axes.insert(axes.end(), {na, nb});
  for (int i = 0; i < 3; ++i) {
    const Vec ea = a.corner[(i + 1) % 3] - a.corner[i], eb = b.corner[(i + 1) % 3] - b.corner[i];
    axes.insert(axes.end(), {cross(ea, na), cross(eb, nb)});
    for (int j = 0; j < 3; ++j) axes.push_back(cross(ea, b.corner[(j + 1) % 3] - b.corner[j]));
  }
  Real best = -1e30L;
  for (const Vec& axis : axes) {
    const Real l = std::sqrt(dot(axis, axis));
    if (!(l > 0)) continue;
    Real low[2] = {1e30L, 1e30L}, high[2] = {-1e30L, -1e30L};
    for (int i = 0; i < 3; ++i) {
      const Real x = dot(axis, a.corner[i]) / l, y = dot(axis, b.corner[i]) / l;
      low[0] = std::min(low[0], x);
      high[0] = std::max(high[0], x);
      low[1] = std::min(low[1], y);
      high[1] = std::max(high[1], y);
    }
    best = std::max({best, low[1] - high[0], low[0] - high[1]});
  }
  return best;
}

/// The maximum depth (minimum best_gap, negated) at `samples + 1` times of [0, end], and when.
struct Deepest {
  Real depth = -1e30L, time = 0;
};
inline Deepest deepest(const TriangleMotion& a, const TriangleMotion& b, Real end, int samples) {
  Deepest d;
  for (int k = 0; k <= samples; ++k) {
    const Real s = end * k / samples, depth = -best_gap(at(a, s), at(b, s));
    if (depth > d.depth) d = {depth, s};
  }
  return d;
}

}  // namespace dismantle::oracle
