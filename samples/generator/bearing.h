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
  ProductId inner_ring, outer_ring, cage, ball;
  std::vector<Placement> ball_places;
};

BearingProducts make_ball_bearing(SampleModel& model, const std::string& name, const BallBearing& bearing);
void place_bearing(SampleModel& model, GroupId group, const BearingProducts& bearing, const Placement& placement);

/// A tapered roller bearing about z; the cup comes off along +z, the rollers then leave outwards.
struct TaperedBearing {
  double bore = 40, outer_diameter = 80, width = 20;
  int rollers = 13;
};

BearingProducts make_tapered_bearing(SampleModel& model, const std::string& name, const TaperedBearing& bearing);

}  // namespace dismantle::samples
