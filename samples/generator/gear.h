// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "samples/generator/solid.h"

namespace dismantle::samples {

/// A spur gear with involute flanks, 20 degrees pressure angle [mm]. Two gears of one module mesh at the sum of their
/// pitch radii, with `backlash` play between the flanks when each tooth sits in the middle of its gap.
struct GearShape {
  double module = 1;
  int teeth = 20;
  double backlash = 0.06;  ///< By which each tooth is thinner than half the pitch, on the pitch circle.
};

double pitch_diameter(const GearShape& gear);
double tip_diameter(const GearShape& gear);
/// The turn about z [degrees] that lets a gear mesh with one that is turned by `first_turn` and lies in the opposite
/// direction: `direction` [degrees] points from the first gear to the second.
double meshing_turn(const GearShape& first, double first_turn, const GearShape& second, double direction);
/// External gear about z with a tooth pointing along +x, from z0 to z1, without a bore.
Solid spur_gear(const GearShape& gear, double z0, double z1);
/// Ring gear with internal teeth and a gap pointing along +x.
Solid ring_gear(const GearShape& gear, double outer_diameter, double z0, double z1);
/// Rack along y whose teeth point along +x: pitch line at x = 0, a tooth centred on y = 0, `teeth` teeth upwards from
/// there, back at x = -back, from z0 to z1.
Solid gear_rack(const GearShape& gear, int teeth, double back, double z0, double z1);

}  // namespace dismantle::samples
