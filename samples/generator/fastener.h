// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "samples/generator/solid.h"

namespace dismantle::samples {

/// Socket head cap screw (ISO 4762), its head standing on the plane z = 0, its shank down to z = -length. The thread is
/// cosmetic: a plain cylinder of the nominal diameter.
Solid cap_screw(double diameter, double length);
/// The same with its thread modelled over the last `thread_length`.
Solid threaded_cap_screw(double diameter, double pitch, double length, double thread_length);
/// The cut for a cap screw with its head flush below z = 0: counterbore, and clearance hole down to -depth.
Solid cap_screw_counterbore(double diameter, double depth);
/// Clearance hole from z = 0 down to -depth.
Solid clearance_hole(double diameter, double depth);
/// Tapped hole for a cosmetic thread, from z = 0 down to -depth: kThreadOverlap narrower than the screw.
Solid tapped_hole(double diameter, double depth);
/// Difference of the diameters of a screw and its tapped hole with a cosmetic thread [mm]: a `fit`.
inline constexpr double kThreadOverlap = 0.24;
/// Hexagon head screw (ISO 4017), its head standing on the plane z = 0, its shank down to z = -length.
Solid hex_screw(double diameter, double length);
/// Set screw with a hexagon socket (ISO 4026), its socket face at z = 0, down to -length.
Solid set_screw(double diameter, double length);
/// Pan head screw with a slot, head standing on z = 0.
Solid slotted_screw(double diameter, double length);
/// Hexagon nut between z = 0 and its height, with a cosmetic thread.
Solid hex_nut(double diameter);
double nut_height(double diameter);
/// Flat washer from z = 0 up.
Solid washer(double diameter);
double washer_thickness(double diameter);
/// Cylindrical pin from z = 0 up.
Solid dowel_pin(double diameter, double length);
/// Open retaining ring in its free state, from z = 0 up: narrower than the groove that it sits in, its gap towards +x.
Solid circlip(double inner_diameter, double width, double thickness);
/// Round knob with a ridged grip and a bore, from z = 0 to `length`.
struct KnobShape {
  double diameter = 20;
  int ridges = 12;
  double length = 10;
  double bore = 4;
};
Solid ridged_knob(const KnobShape& knob);
/// Handwheel about z with a rim, three spokes, and a hub from z = 0 to 1.6 rim widths.
struct HandwheelShape {
  double diameter = 100;
  double rim_width = 12;
  double bore = 12;
};
Solid handwheel(const HandwheelShape& wheel);
/// Diameter of the head of a cap screw; its height is the nominal diameter.
double cap_head_diameter(double diameter);

}  // namespace dismantle::samples
