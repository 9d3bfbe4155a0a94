// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/mat3.h"

#include <cmath>

namespace dismantle {

/// A rotation as a unit quaternion [w, x, y, z]; the identity by default.
struct Quat {
  double w = 1;  ///< Real part.
  double x = 0;  ///< Coefficient of i.
  double y = 0;  ///< Coefficient of j.
  double z = 0;  ///< Coefficient of k.

  friend constexpr bool operator==(const Quat&, const Quat&) = default;
  /// The Hamilton product: the rotation `a` after `b`.
  DISMANTLE_HOST_DEVICE friend constexpr Quat operator*(const Quat& a, const Quat& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
  }
  /// The same rotation with all signs changed.
  DISMANTLE_HOST_DEVICE friend constexpr Quat operator-(const Quat& q) { return {-q.w, -q.x, -q.y, -q.z}; }
};

/// The inverse rotation of a unit quaternion.
DISMANTLE_HOST_DEVICE constexpr Quat conjugate(const Quat& q) {
  return {q.w, -q.x, -q.y, -q.z};
}

/// The inner product of the four coefficients.
DISMANTLE_HOST_DEVICE constexpr double dot(const Quat& a, const Quat& b) {
  return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}

/// `q` scaled to unit length; the zero quaternion becomes the identity.
inline Quat normalized(const Quat& q) {
  const double l = std::sqrt(dot(q, q));
  return l > 0 ? Quat{q.w / l, q.x / l, q.y / l, q.z / l} : Quat{};
}

/// The same rotation as `q`: of `q` and `-q`, the one that is nearer to `other`.
DISMANTLE_HOST_DEVICE constexpr Quat nearer_to(const Quat& other, const Quat& q) {
  return dot(other, q) < 0 ? -q : q;
}

/// The rotation by `angle` [rad] about the unit vector `axis`, right-handed.
inline Quat quat_about(Vec3 axis, double angle) {
  const double s = std::sin(angle / 2);
  return {std::cos(angle / 2), s * axis.x, s * axis.y, s * axis.z};
}

/// The rotation matrix of the unit quaternion `q`.
DISMANTLE_HOST_DEVICE inline Mat3 mat3_from_quat(const Quat& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
           {2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
           {2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}}};
}

/// The unit quaternion of a rotation matrix (w >= 0).
inline Quat quat_from_mat3(const Mat3& m) {
  const double trace = m.row[0].x + m.row[1].y + m.row[2].z;
  Quat q;
  if (trace > 0) {
    const double s = std::sqrt(trace + 1) * 2;
    q = {s / 4, (m.row[2].y - m.row[1].z) / s, (m.row[0].z - m.row[2].x) / s, (m.row[1].x - m.row[0].y) / s};
  } else if (m.row[0].x > m.row[1].y && m.row[0].x > m.row[2].z) {
    const double s = std::sqrt(1 + m.row[0].x - m.row[1].y - m.row[2].z) * 2;
    q = {(m.row[2].y - m.row[1].z) / s, s / 4, (m.row[0].y + m.row[1].x) / s, (m.row[0].z + m.row[2].x) / s};
  } else if (m.row[1].y > m.row[2].z) {
    const double s = std::sqrt(1 + m.row[1].y - m.row[0].x - m.row[2].z) * 2;
    q = {(m.row[0].z - m.row[2].x) / s, (m.row[0].y + m.row[1].x) / s, s / 4, (m.row[1].z + m.row[2].y) / s};
  } else {
    const double s = std::sqrt(1 + m.row[2].z - m.row[0].x - m.row[1].y) * 2;
    q = {(m.row[1].x - m.row[0].y) / s, (m.row[0].z + m.row[2].x) / s, (m.row[1].z + m.row[2].y) / s, s / 4};
  }
  q = normalized(q);
  return q.w < 0 ? -q : q;
}

}  // namespace dismantle
