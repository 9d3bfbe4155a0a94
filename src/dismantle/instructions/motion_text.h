// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/instructions/work_steps.h"

#include <string>
#include <vector>

namespace dismantle {

/// A stretch of a way that is gone in one go: straight on, or turning about one axis while going along it.
struct Leg {
  Vec3 direction;     ///< Unit: straight on, or of the axis in the sense in which it turns.
  double length = 0;  ///< Along `direction`; below 0 against it [mm].
  double angle = 0;   ///< [rad]; 0 where it goes straight.
  Vec3 axis_point;    ///< On the axis, where it turns [mm].
};

/// The legs of a removal's way. What goes on in one direction, or about one axis, is one leg.
std::vector<Leg> legs_of(const RemovalMove& removal, const Vec3& middle);

/// A leg that turns by at least half a turn while it goes along its axis: out of, or into, a thread.
bool is_screwing(const Leg& leg);

/// "up", "down", "along +X" for the axes, z being up; else "along the arrow".
std::string direction_words(const Vec3& unit);

/// The way in the sense of `direction` as a sentence: "Turn 4.5 times anticlockwise (seen from where it comes out),
/// then straight up." Ways of many legs are told by their lengths.
std::string motion_text(const std::vector<Leg>& legs, PathDirection direction);

/// A number with three digits, for people.
std::string number_text(double value);

}  // namespace dismantle
