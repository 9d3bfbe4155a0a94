// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/gear.h"

#include <algorithm>
#include <cmath>

namespace dismantle::samples {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kPressureAngle = 20 * kPi / 180;
constexpr double kAddendum = 1.0;   ///< In modules.
constexpr double kDedendum = 1.25;  ///< In modules: leaves a quarter module at the tip.
constexpr int kFlankSegments = 2;   ///< Straight pieces that follow an involute.

double involute(double angle) {
  return std::tan(angle) - angle;
}

/// Half the angle that a tooth fills at that radius.
double half_tooth_angle(const GearShape& gear, double radius) {
  const double pitch_radius = pitch_diameter(gear) / 2;
  const double base_radius = pitch_radius * std::cos(kPressureAngle);
  const double at_pitch = (kPi * gear.module / 2 - gear.backlash) / (2 * pitch_radius);
  const double pressure = std::acos(std::min(1.0, base_radius / std::max(radius, base_radius)));
  return at_pitch + involute(kPressureAngle) - involute(pressure);
}

/// The closed outline of all teeth between two radii; a tooth is centred on angle 0.
Outline teeth_outline(const GearShape& gear, double low_radius, double high_radius) {
  Outline outline;
  auto add = [&](double radius, double angle) {
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  };
  for (int tooth = 0; tooth < gear.teeth; ++tooth) {
    const double centre = 2 * kPi * tooth / gear.teeth;
    for (int side = -1; side <= 1; side += 2)
      for (int i = 0; i <= kFlankSegments; ++i) {
        const int step = side < 0 ? i : kFlankSegments - i;
        const double radius = low_radius + (high_radius - low_radius) * step / kFlankSegments;
        add(radius, centre + side * half_tooth_angle(gear, radius));
      }
  }
  return outline;
}

}  // namespace

double pitch_diameter(const GearShape& gear) {
  return gear.module * gear.teeth;
}
double tip_diameter(const GearShape& gear) {
  return pitch_diameter(gear) + 2 * kAddendum * gear.module;
}

double meshing_turn(const GearShape& first, double first_turn, const GearShape& second, double direction) {
  // Offset of the line of centres from a tooth of the first gear, in pitches; the second turns the other way.
  const double past_tooth = (direction - first_turn) * first.teeth / 360;
  return direction + 180 + (past_tooth + 0.5) * 360 / second.teeth;
}

Solid spur_gear(const GearShape& gear, double z0, double z1) {
  const double pitch_radius = pitch_diameter(gear) / 2;
  return extruded(teeth_outline(gear, pitch_radius - kDedendum * gear.module, pitch_radius + kAddendum * gear.module),
                  z0, z1);
}

Solid ring_gear(const GearShape& gear, double outer_diameter, double z0, double z1) {
  const double pitch_radius = pitch_diameter(gear) / 2;
  GearShape gap = gear;
  gap.backlash = -gear.backlash;
  const Outline inner =
      teeth_outline(gap, pitch_radius - kAddendum * gear.module, pitch_radius + kDedendum * gear.module);
  return rod(outer_diameter, z0, z1) - extruded(inner, z0 - 1, z1 + 1);
}

Solid gear_rack(const GearShape& gear, int teeth, double back, double z0, double z1) {
  const double pitch = kPi * gear.module, slope = std::tan(kPressureAngle);
  const double tip = kAddendum * gear.module, root = -kDedendum * gear.module;
  const double half = pitch / 4 - gear.backlash / 2;
  Outline outline{{-back, -pitch / 2}};
  for (int i = 0; i < teeth; ++i) {
    const double y = pitch * i;
    if (i == 0) outline.push_back({root, -pitch / 2});
    outline.push_back({root, y - half + root * slope});
    outline.push_back({tip, y - half + tip * slope});
    outline.push_back({tip, y + half - tip * slope});
    outline.push_back({root, y + half - root * slope});
  }
  outline.push_back({root, pitch * (teeth - 0.5)});
  outline.push_back({-back, pitch * (teeth - 0.5)});
  return extruded(outline, z0, z1);
}

}  // namespace dismantle::samples
