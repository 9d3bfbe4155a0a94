// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "samples/generator/sample_model.h"

#include <string>

namespace dismantle::samples {

/// A separable ball bearing (magneto type: the outer ring has one shoulder only and slides off along +z, then the balls
/// leave the cage outwards) about z, from z = 0 to `width` [mm].
struct BallBearing {
  double bore = 8, outer_diameter = 22, width = 7;
  int balls = 7;
};

/// The products of a bearing, shared by its instances.
struct BearingProducts {
  ProductId inner_ring, outer_ring, body;
  ProductId cage;                 ///< None (index -1) in a full-complement bearing.
  std::vector<Placement> bodies;  ///< Where the balls or rollers sit.
};

BearingProducts make_ball_bearing(SampleModel& model, const std::string& name, const BallBearing& bearing);

/// A full-complement cylindrical roller bearing about z: the outer ring is plain and slides off either way, the rollers
/// then leave outwards.
struct RollerBearing {
  double bore = 20, outer_diameter = 42, width = 12;
  int rollers = 14;
};

BearingProducts make_roller_bearing(SampleModel& model, const std::string& name, const RollerBearing& bearing);

/// A tapered roller bearing about z; the cup comes off along +z, the rollers then leave outwards.
struct TaperedBearing {
  double bore = 40, outer_diameter = 80, width = 20;
  int rollers = 13;
};

BearingProducts make_tapered_bearing(SampleModel& model, const std::string& name, const TaperedBearing& bearing);

/// Places a bearing's rings, cage, and rolling bodies.
void place_bearing(SampleModel& model, GroupId group, const BearingProducts& bearing, const Placement& placement);

}  // namespace dismantle::samples
