// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "samples/generator/solid.h"

namespace dismantle::samples {

/// A right-handed single-start screw thread about z [mm]. In the axial section the ridge is a trapezoid.
struct ThreadForm {
  double pitch = 1;
  double root_radius = 1;
  double crest_radius = 1;
  double crest_width = 0.125;  ///< Along z.
  double flank_width = 0.3;    ///< Along z, of each flank.
};

/// The external thread of ISO metric form for a nominal diameter and pitch.
ThreadForm metric_thread(double diameter, double pitch);
/// A trapezoidal lead-screw thread (DIN 103 proportions).
ThreadForm trapezoidal_thread(double diameter, double pitch);
/// The thread that an internal thread must have to take `form` with this much play on every side: cut it away.
ThreadForm with_play(const ThreadForm& form, double radial, double axial);

/// A rod of the root radius from z0 to z1 with the ridge on it from z0 + lead_in to at most z1 - lead_out in whole half
/// turns; plain at the ends (a relief groove). The ridge starts at angle 0 where it meets z0 + lead_in.
/// @pre there is room for one turn.
Solid threaded_rod(const ThreadForm& form, double z0, double z1, double lead_in, double lead_out);

/// A compression spring of rectangular wire (die spring, ISO 10243 look) about z, from z = 0 to `length`, its ends
/// ground flat.
struct SpringShape {
  double outer_diameter = 20, inner_diameter = 10;
  double wire_height = 3;  ///< Along z.
  double length = 50;
  double turns = 6;
};
Solid die_spring(const SpringShape& spring);

}  // namespace dismantle::samples
