// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/quat.h"

namespace dismantle {

/// A rigid motion as a matrix: x -> rotation * x + translation; the form in which kernels apply it.
struct RigidTransform {
  Mat3 rotation;     ///< Orthogonal, determinant 1.
  Vec3 translation;  ///< [mm]

  /// The image of a point [mm].
  DISMANTLE_HOST_DEVICE friend Vec3 operator*(const RigidTransform& t, Vec3 point) {
    return t.rotation * point + t.translation;
  }
  /// `a` after `b`.
  DISMANTLE_HOST_DEVICE friend RigidTransform operator*(const RigidTransform& a, const RigidTransform& b) {
    return {a.rotation * b.rotation, a.rotation * b.translation + a.translation};
  }
  /// True if all numbers are equal.
  DISMANTLE_HOST_DEVICE friend bool operator==(const RigidTransform& a, const RigidTransform& b) {
    return a.rotation == b.rotation && a.translation == b.translation;
  }
};

/// The inverse rigid transform.
DISMANTLE_HOST_DEVICE inline RigidTransform inverse(const RigidTransform& t) {
  const Mat3 rt = transposed(t.rotation);
  return {rt, -(rt * t.translation)};
}

/// The pose of a component: x_now = R(rotation) * x_assembled + position; the form that files and sessions keep. The
/// assembled pose is the default.
struct Pose {
  Vec3 position;  ///< [mm]
  Quat rotation;  ///< Unit length.

  /// True if all numbers are equal.
  friend bool operator==(const Pose& a, const Pose& b) { return a.position == b.position && a.rotation == b.rotation; }
};

/// The pose as a matrix.
inline RigidTransform transform_from_pose(const Pose& p) {
  return {mat3_from_quat(p.rotation), p.position};
}

/// `a` after `b`: x -> a(b(x)), its rotation normalised.
inline Pose operator*(const Pose& a, const Pose& b) {
  return {mat3_from_quat(a.rotation) * b.position + a.position, normalized(a.rotation * b.rotation)};
}

/// The inverse pose.
inline Pose inverse(const Pose& p) {
  const Quat q = conjugate(p.rotation);
  return {-(mat3_from_quat(q) * p.position), q};
}

}  // namespace dismantle
