// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"

#include <string>
#include <vector>

namespace dismantle::samples {

/// One component, or several together, led away by a hand that is not quite steady.
struct HandMove {
  std::vector<std::string> components;
  Vec3 direction;        ///< Where the hand pulls; unit length.
  double distance = 50;  ///< Along it [mm].
  double turns = 0;      ///< Right-handed about the direction through `axis_point`: screws.
  Vec3 axis_point;       ///< Assembly frame [mm].
  Vec3 then;             ///< And on by this [mm], to where it is put down: often into a neighbour.
};

/// A motion with `steps` targets a move, response touch. Each move pulls along its direction, with a small tremor, then
/// moves on by `then`. The same for every run.
Motion hand_motion(const std::vector<HandMove>& moves, int steps);

/// The bundled motion of a sample: a few components in the order in which one takes it apart. Throws
/// std::invalid_argument for a name that is no sample's.
Motion make_sample_motion(const std::string& sample);

}  // namespace dismantle::samples
