// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/instructions/work_steps.h"

#include <string>
#include <vector>

namespace dismantle {

/// A section of a removal path: a translation, or a screw motion about one axis.
struct Leg {
  Vec3 direction;     ///< Unit vector: of the translation, or of the axis so that the rotation is positive.
  double length = 0;  ///< Translation along `direction`; negative if against it [mm].
  double angle = 0;   ///< Rotation [rad]; 0 for a translation.
  Vec3 axis_point;    ///< A point on the axis of a screw motion [mm].
};

/// The legs of a removal path. Successive motions in one direction or about one axis are merged.
/// @param center of the assembled set [mm]
std::vector<Leg> legs_of(const RemovalMove& removal, const Vec3& center);

/// True for a screw motion of at least half a turn with a translation, as out of or into a thread.
bool is_screwing(const Leg& leg);

/// "up", "down" or "along +X" for a direction along an axis, z being up; otherwise "along the arrow".
std::string direction_words(const Vec3& unit);

/// Describes the motion in the given direction as a sentence: "Unscrew 4.5 turns anticlockwise (seen from the side
/// where it comes out), moving out 4.5 mm, then straight up." A path of many legs is summarised by its length and
/// rotation.
std::string motion_text(const std::vector<Leg>& legs, PathDirection direction);

/// A number with three significant digits, for display.
std::string number_text(double value);

}  // namespace dismantle
