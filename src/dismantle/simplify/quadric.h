// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

namespace dismantle {

/// A sum of squared distances to planes as a quadratic function of the point x [mm]: x^T A x + 2 b.x + c, A symmetric
/// (Garland and Heckbert 1997).
struct Quadric {
  ///@{ Elements of A.
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  ///@}
  Vec3 b;        ///< The linear term [mm].
  double c = 0;  ///< The constant [mm^2].

  /// Adds the planes of another quadric.
  Quadric& operator+=(const Quadric& q) {
    xx += q.xx;
    xy += q.xy;
    xz += q.xz;
    yy += q.yy;
    yz += q.yz;
    zz += q.zz;
    b += q.b;
    c += q.c;
    return *this;
  }
};

/// The squared distance to the plane through `point` with the unit normal `n`, times `weight`.
inline Quadric plane_quadric(Vec3 n, Vec3 point, double weight) {
  const double d = -dot(n, point);
  return {weight * n.x * n.x, weight * n.x * n.y, weight * n.x * n.z, weight * n.y * n.y,
          weight * n.y * n.z, weight * n.z * n.z, (weight * d) * n,   weight * d * d};
}

/// The quadric's value at a point [mm^2]; negative values, which rounding can give, count as 0.
inline double evaluate(const Quadric& q, Vec3 p) {
  const double value = p.x * (q.xx * p.x + 2 * q.xy * p.y + 2 * q.xz * p.z) + p.y * (q.yy * p.y + 2 * q.yz * p.z) +
                       q.zz * p.z * p.z + 2 * dot(q.b, p) + q.c;
  return value > 0 ? value : 0;
}

}  // namespace dismantle
