// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

#include <cstdint>

namespace dismantle {

/// A rotation matrix and a translation in float32.
struct RigidTransformF {
  Vec3f row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< Rows of the rotation matrix.
  Vec3f translation;                                 ///< [mm]
};

/// The motion of component A in the frame of component B during a sweep, in the form that the front's kernels use: from
/// the frame of A's tree to that of B's. Points move linearly from their position under `t0` to that under `t1`.
struct LinearSweep {
  RigidTransformF t0;  ///< The transform at the start of the sweep.
  RigidTransformF t1;  ///< The transform at its end.
  Vec3f middle[3];     ///< Rows of the rotation half way, for which new axes are sought.
  /// A gap of at least this certifies a pair for the whole sweep: minus the allowed penetration, plus bounds of the
  /// rounding and of the arcs' deviation from their chords [mm].
  float limit = 0;
  float error = 0;  ///< Bound of the rounding error of a gap [mm].
  /// The sweep of a part of the front may stop after this many blocked pairs, a sample spread over the part.
  std::uint32_t max_blocked = 0xffffffffu;
};

/// The convex hull of a node of A as a certificate stores it, in A's frame [mm]: a box, i.e. the points center + t0
/// span[0] + t1 span[1] + t2 span[2] with |ti| <= 1; or a triangle with the corners center, center + span[0] and
/// center + span[1].
struct NodeHull {
  Vec3f center;   ///< Center of the box, or first corner of the triangle.
  Vec3f span[3];  ///< Half axes of the box, or two edges of the triangle.
  ///@{ Values of `kind`. kNone: the pair is separated by something other than a plane.
  static constexpr float kNone = -1, kBox = 0, kTriangle = 1;
  ///@}
  float kind = kBox;  ///< One of the values above, as a number for lanes.
};

/// Offset of a certificate that proves nothing.
inline constexpr float kNoCertificate = -1e30f;

/// A separating plane of two nodes or triangles, valid for every pose of A: along the unit vector `axis` (from A to B,
/// in B's frame) their gap is offset - axis.t - max over p in the hull of axis.(R p), where x -> R x + t is the pose of
/// A.
struct Certificate {
  Vec3f axis;        ///< Unit, from A to B [frame of B's tree].
  float offset = 0;  ///< [mm]
  NodeHull hull;     ///< Of A's node.

  /// The certificate that proves nothing.
  static Certificate none() { return {{}, kNoCertificate, {}}; }
  /// Sentinel: the pair is separated by a RadialSweep or a ThreadSweep, not by a plane.
  static Certificate radial() {
    Certificate certificate = none();
    certificate.hull.kind = NodeHull::kNone;
    return certificate;
  }
  /// The same for a ThreadSweep, with what it keeps for sweeps to come (ThreadSweep::kept_gap).
  /// @param match index of the threads @param gap of the two nodes, their threads in place [mm]
  /// @param phase of the moving thread [mm]
  static Certificate thread(std::uint32_t match, float gap, float phase) {
    Certificate certificate = radial();
    certificate.hull.center = {static_cast<float>(match), gap, phase};
    return certificate;
  }
};

}  // namespace dismantle
