// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/quat.h"

namespace dismantle {

/// A rigid motion as a matrix: x -> rotation * x + translation [mm]. What kernels apply to vertices.
struct RigidTransform {
  Mat3 rotation;
  Vec3 translation;

  DISMANTLE_HOST_DEVICE friend Vec3 operator*(const RigidTransform& t, Vec3 point) {
    return t.rotation * point + t.translation;
  }
  DISMANTLE_HOST_DEVICE friend RigidTransform operator*(const RigidTransform& a, const RigidTransform& b) {
    return {a.rotation * b.rotation, a.rotation * b.translation + a.translation};
  }
  DISMANTLE_HOST_DEVICE friend bool operator==(const RigidTransform& a, const RigidTransform& b) {
    return a.rotation == b.rotation && a.translation == b.translation;
  }
};

/// The inverse of a rigid transform (its rotation is orthogonal).
DISMANTLE_HOST_DEVICE inline RigidTransform inverse(const RigidTransform& t) {
  const Mat3 rt = transposed(t.rotation);
  return {rt, -(rt * t.translation)};
}

/// A pose as files and sessions keep it: x_now = R(rotation) * x_assembled + position. The assembled pose is the
/// default.
struct Pose {
  Vec3 position;  ///< [mm]
  Quat rotation;  ///< unit length

  friend bool operator==(const Pose& a, const Pose& b) { return a.position == b.position && a.rotation == b.rotation; }
};

inline RigidTransform transform_from_pose(const Pose& p) {
  return {mat3_from_quat(p.rotation), p.position};
}

/// `a` after `b`: x -> a(b(x)), its rotation normalised.
inline Pose operator*(const Pose& a, const Pose& b) {
  return {mat3_from_quat(a.rotation) * b.position + a.position, normalized(a.rotation * b.rotation)};
}

inline Pose inverse(const Pose& p) {
  const Quat q = conjugate(p.rotation);
  return {-(mat3_from_quat(q) * p.position), q};
}

}  // namespace dismantle
