// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/ghosts/find_pair_ghosts.h"
#include "dismantle/math/rigid_transform.h"

#include <array>
#include <optional>
#include <vector>

namespace dismantle {

/// The side to which two sheets that lie on each other come apart. In the assembled state it may be either: the ghosts
/// of both sheets, or their mirror images, which are displaced the opposite way. The first motion of one sheet past the
/// other decides, until the two have been apart or jump back to the assembled state
/// (docs/design/0012-ghost-surfaces.md).
struct SheetSides {
  bool both = false;      ///< Both are possible; false for all other pairs.
  Vec3 point;             ///< A point of the first sheet [mm, assembled].
  Vec3 direction;         ///< The way by which the ghosts as found let that sheet leave, unit [assembled].
  bool mirrored = false;  ///< The mirrored ghosts are in use.
  bool decided = false;   ///< The two have moved past each other since the last jump.

  /// True if a motion of the first sheet from the assembled state needs the mirrored ghosts.
  /// @param end the first sheet as seen from the second one [assembled frame of that one]
  bool needs_mirrored(const RigidTransform& end, double tolerance) const {
    return both && offset(end) < -kEither * tolerance;
  }
  /// Decides for a motion. @param assembled it starts in the assembled state
  /// @return true if other ghosts are in use now
  bool begin_motion(bool assembled, const RigidTransform& end, double tolerance);
  /// Decides after a jump. @param assembled the two are in the assembled state
  /// @return true if other ghosts are in use now
  bool jump(bool assembled, const RigidTransform& at, double tolerance);

 private:
  /// Motions along the sheets, as far as this share of the tolerance can tell, are free with the ghosts of either side.
  static constexpr double kEither = 1e-6;

  double offset(const RigidTransform& at) const { return dot(direction, at * point - point); }
};

/// The ghosts of two sheets, mirrored.
struct MirroredGhosts {
  std::array<std::vector<Vec3>, 2> vertices;  ///< Displaced vertices of `a` and `b` [mm, assembled].
  SheetSides sides;                           ///< Undecided.
};

/// Mirrors the ghosts of two sheets at their surfaces. Nothing if one of the two is a solid, if they are not shifted as
/// a whole, or where the other sheet is in the way of the mirror image, or meets it.
std::optional<MirroredGhosts> mirrored_ghosts(const PairGhostRequest& request, const PairGhosts& ghosts);

}  // namespace dismantle
