// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/fastener.h"

#include "samples/generator/thread.h"

#include <cmath>

namespace dismantle::samples {
namespace {

/// Fine enough for the pictures, coarse enough for the triangle budget: sizes grow with the diameter as in the norms.
double socket_across_flats(double diameter) {
  return std::round(diameter * 0.8 * 2) / 2;
}

Solid cap_head(double diameter) {
  return rod(cap_head_diameter(diameter), 0, diameter) -
         prism(6, socket_across_flats(diameter), 0.45 * diameter, diameter + 1);
}

double hex_across_flats(double diameter) {
  return std::round(1.6 * diameter + 0.5);
}

}  // namespace

double cap_head_diameter(double diameter) {
  return std::round((1.5 * diameter + 1) * 2) / 2;
}

Solid cap_screw(double diameter, double length) {
  return cap_head(diameter) + rod(diameter, -length, 0);
}

Solid threaded_cap_screw(double diameter, double pitch, double length, double thread_length) {
  const ThreadForm form = metric_thread(diameter, pitch);
  const Solid thread = threaded_rod(form, -length, -length + thread_length, 0.5 * pitch, 0.25 * pitch);
  const Solid shank = rod(diameter, -length + thread_length, 0);
  return cap_head(diameter) + std::vector<Solid>{shank, thread};
}

Solid cap_screw_counterbore(double diameter, double depth) {
  return rod(cap_head_diameter(diameter) + 0.5, -diameter - 0.4, 0.0) + rod(1.1 * diameter, -depth, -diameter - 0.4);
}

Solid clearance_hole(double diameter, double depth) {
  return rod(1.1 * diameter, -depth, 0);
}

Solid tapped_hole(double diameter, double depth) {
  return rod(diameter - kThreadOverlap, -depth, 0);
}

Solid hex_screw(double diameter, double length) {
  return prism(6, hex_across_flats(diameter), 0, 0.65 * diameter) + rod(diameter, -length, 0);
}

Solid set_screw(double diameter, double length) {
  return rod(diameter, -length, 0) - prism(6, 0.5 * diameter, -0.5 * length, 1);
}

Solid slotted_screw(double diameter, double length) {
  const double head = 2 * diameter, height = 0.6 * diameter, half_slot = 0.15 * diameter;
  const Solid body = rod(head, 0, height) + rod(diameter, -length, 0);
  return body - block({-head, -half_slot, 0.5 * height}, {head, half_slot, height + 1});
}

double nut_height(double diameter) {
  return std::round(0.8 * diameter * 10) / 10;
}

Solid hex_nut(double diameter) {
  return prism(6, hex_across_flats(diameter), 0, nut_height(diameter)) - rod(diameter - kThreadOverlap, -1, diameter);
}

double washer_thickness(double diameter) {
  return std::round(0.16 * diameter * 10) / 10 + 0.1;
}

Solid washer(double diameter) {
  return tube(2 * diameter, 1.07 * diameter, 0, washer_thickness(diameter));
}

Solid dowel_pin(double diameter, double length) {
  return rod(diameter, 0, length);
}

Solid circlip(double inner_diameter, double width, double thickness) {
  const double outer = inner_diameter + 2 * width, half_gap = 0.2 * inner_diameter;
  return tube(outer, inner_diameter, 0, thickness) - block({0, -half_gap, -1}, {outer, half_gap, thickness + 1});
}

Solid ridged_knob(const KnobShape& knob) {
  constexpr double kPi = 3.14159265358979323846;
  Outline outline;
  for (int i = 0; i < 2 * knob.ridges; ++i) {
    const double radius = knob.diameter / 2 * (i % 2 == 0 ? 1 : 0.94), angle = kPi * i / knob.ridges;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return extruded(outline, 0, knob.length) - rod(knob.bore, -1, knob.length + 1);
}

Solid handwheel(const HandwheelShape& wheel) {
  const double width = wheel.rim_width, radius = wheel.diameter / 2, hub = 1.2 * wheel.bore;
  const Solid spoke = block({0, -0.35 * width, 0.2 * width}, {radius - 0.5 * width, 0.35 * width, 0.8 * width});
  std::vector<Solid> parts = at_each(spoke, around_z(3, 0));
  parts.push_back(rod(2 * hub, 0, 1.6 * width));
  return (tube(wheel.diameter, wheel.diameter - 2 * width, 0, width) + parts) - rod(wheel.bore, -1, 2 * width);
}

}  // namespace dismantle::samples
