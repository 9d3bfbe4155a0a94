// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/separating_axis.h"

namespace dismantle {

/// A cubic on [0, 1] in Bernstein form: the sum of B_k(t) c[k] with B = (1-t)^3, 3(1-t)^2 t, 3(1-t) t^2, t^3.
struct BernsteinCubic {
  double c[4] = {};  ///< The coefficients.
  double error = 0;  ///< Error bound of every coefficient, against exact arithmetic on the doubles of the input.
};

/// The largest absolute value of a coefficient.
DISMANTLE_HOST_DEVICE inline double largest_coefficient(const BernsteinCubic& cubic) {
  double largest = 0;
  for (const double c : cubic.c) {
    const double size = absolute(c);
    largest = largest > size ? largest : size;
  }
  return largest;
}

/// The relative error bound of a coefficient of coplanarity_cubic(): with P, Q, R the largest coordinates of the
/// three differences, each is an average of at most three triple products of differences. A triple product of rounded
/// differences has an error of at most (7 + 56u)u times the sum of the absolute values of its six terms (Shewchuk 1997,
/// orient3d), which is at most 6 P Q R; the averages add less than 5 roundings. Hence 13 * 6 u < 80 u; 96 u is stated.
inline constexpr double kCoplanarityRelativeError = 96 * 0x1p-53;

/// p(t) x q(t) . r(t) of three vectors that move linearly, by their values at t = 0 and 1.
DISMANTLE_HOST_DEVICE inline BernsteinCubic coplanarity_cubic(const Vec3 (&p)[2], const Vec3 (&q)[2],
                                                              const Vec3 (&r)[2]) {
  const Vec3 start = cross(p[0], q[0]), end = cross(p[1], q[1]);
  const Vec3 twice_middle = cross(p[0], q[1]) + cross(p[1], q[0]);
  BernsteinCubic cubic;
  cubic.c[0] = dot(start, r[0]);
  cubic.c[1] = (dot(start, r[1]) + dot(twice_middle, r[0])) / 3;
  cubic.c[2] = (dot(end, r[0]) + dot(twice_middle, r[1])) / 3;
  cubic.c[3] = dot(end, r[1]);

  const auto largest = [](const Vec3(&v)[2]) {
    const Vec3 m = max(absolute(v[0]), absolute(v[1]));
    const double xy = m.x > m.y ? m.x : m.y;
    return xy > m.z ? xy : m.z;
  };
  // The last term covers products that underflow.
  cubic.error = kCoplanarityRelativeError * (largest(p) * largest(q) * largest(r)) + 0x1p-1020 * (largest(r) + 1);
  return cubic;
}

/// Six times the signed volume of the four points over time: zero exactly where the vertex is in the plane of the face.
DISMANTLE_HOST_DEVICE inline BernsteinCubic coplanarity_cubic(const VertexFaceMotion& m) {
  return coplanarity_cubic({m.face_t0[1] - m.face_t0[0], m.face_t1[1] - m.face_t1[0]},
                           {m.face_t0[2] - m.face_t0[0], m.face_t1[2] - m.face_t1[0]},
                           {m.vertex_t0 - m.face_t0[0], m.vertex_t1 - m.face_t1[0]});
}

/// Six times the signed volume of the four end points over time: zero exactly where they are coplanar.
DISMANTLE_HOST_DEVICE inline BernsteinCubic coplanarity_cubic(const EdgeEdgeMotion& m) {
  return coplanarity_cubic({m.a_t0[1] - m.a_t0[0], m.a_t1[1] - m.a_t1[0]},
                           {m.b_t0[1] - m.b_t0[0], m.b_t1[1] - m.b_t1[0]},
                           {m.b_t0[0] - m.a_t0[0], m.b_t1[0] - m.a_t1[0]});
}

}  // namespace dismantle
