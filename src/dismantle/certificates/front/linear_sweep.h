// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

#include <cstdint>

namespace dismantle {

/// A rotation matrix and a translation in float32.
struct RigidTransformF {
  Vec3f row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vec3f translation;
};

/// The motion of component A in the frame of component B during a sweep, as the front's kernels take it: from the frame
/// of A's tree to that of B's. Points go linearly from where `t0` has them to where `t1` has them.
struct LinearSweep {
  RigidTransformF t0, t1;
  Vec3f middle[3];  ///< Rows of the rotation half way: where new axes are looked for.
  /// A gap of at least this certifies a pair for the whole sweep: minus the allowed penetration, plus what rounding and
  /// the arcs' deviation from their chords may take [mm].
  float limit = 0;
  float meeting = 0;  ///< With a gap of less than this [mm] a pair may be in each other.
  float apart = 0;    ///< With a gap of at least this [mm] a pair may be on any side of each other.
  float allowed = 0;  ///< How deep triangles may be in each other [mm].
  float error = 0;    ///< What rounding may take from a gap [mm].
  /// False where A has turned too far for the front's certificates to face along its normals still.
  bool judged = true;
  /// So many blocked pairs of each part of the front are enough, spread over all of it; the rest may be left unlooked
  /// at.
  std::uint32_t enough_blocked = 0xffffffffu;
};

/// What of a node of A matters to a certificate, in A's frame [mm]: a box, the points center + t0 span[0] + t1 span[1]
/// + t2 span[2] with |ti| <= 1; or a triangle, whose corners are center, center + span[0] and center + span[1].
struct NodeHull {
  Vec3f center;
  Vec3f span[3];
  /// A number, for lanes. On edge: a triangle whose certificate lets it be in the other along an axis that does not
  /// lead well out of the one face and into the other, though its component is closed. None: what proves the pair is no
  /// such certificate.
  static constexpr float kNone = -1, kBox = 0, kTriangle = 1, kTriangleOnEdge = 2;
  float kind = kBox;
};

/// The offset of a certificate that says nothing.
inline constexpr float kNoCertificate = -1e30f;
/// The offset of one of which only the side is left.
inline constexpr float kForgottenCertificate = -1e29f;

/// A fact about two nodes or triangles, true for every pose of A: along the unit vector `axis` (from A to B, B's frame)
/// their gap is offset - axis.t - max over p in the hull of axis.(R p), with x -> R x + t the pose of A.
struct Certificate {
  Vec3f axis;
  float offset = 0;  ///< [mm]
  NodeHull hull;

  static Certificate none() { return {{}, kNoCertificate, {}}; }
  /// Marks what is parted as round: says nothing by itself.
  static Certificate of_round() {
    Certificate certificate = none();
    certificate.hull.kind = NodeHull::kNone;
    return certificate;
  }
};

}  // namespace dismantle
