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
struct PairSweep {
  /// How many reference rotations certificates may be about before they have to be made anew.
  static constexpr std::uint32_t kEpochs = 8;

  RigidTransformF t0, t1;
  Vec3f middle[3];  ///< Rows of the rotation half way: what new certificates refer to.
  float turn = 0;   ///< The largest change of a unit vector between `middle` and either end.
  /// A gap of at least this certifies a pair for the whole sweep: minus the allowed penetration, plus what rounding and
  /// the arcs' deviation from their chords may take [mm].
  float limit = 0;
  float apart = 0;           ///< With a gap of at least this [mm] a pair may be on any side of each other.
  float allowed = 0;         ///< How deep triangles may be in each other [mm].
  float error = 0;           ///< What rounding may take from a gap [mm].
  std::uint32_t epoch = 0;   ///< The number of `middle` among the front's reference rotations.
  float turn_t0[kEpochs]{};  ///< As `turn`, from the last references (by number modulo kEpochs) to t0's rotation.
  float turn_t1[kEpochs]{};
};

/// The offset of a certificate that says nothing.
inline constexpr float kNoCertificate = -1e30f;

/// A fact about two nodes or triangles, true for every pose of A: along the unit vector `axis` (from A to B, B's frame)
/// their gap is at least offset - axis.(R p + t) - |R - R_epoch| radius, with x -> R x + t the pose of A.
struct Certificate {
  Vec3f axis;
  Vec3f point;       ///< p, in A's frame [mm].
  float offset = 0;  ///< [mm]
  float radius = 0;  ///< No point of A's node is further from p than that [mm].
  std::uint32_t epoch = 0;
};

}  // namespace dismantle
