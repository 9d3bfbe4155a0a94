// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/swept_meshes.h"

namespace dismantle::scenes {

/// A spur gear with involute teeth, pressure angle 20 degrees, about z. No undercut from 18 teeth on.
struct Gear {
  std::uint32_t teeth = 20;
  double module = 2;         ///< [mm]
  double backlash = 0;       ///< Reduction of each tooth's thickness at the pitch circle [mm].
  double width = 10;         ///< Along z, from 0 [mm]
  double bore = 5;           ///< Radius [mm]
  std::uint32_t points = 6;  ///< On a flank.
  std::uint32_t layers = 1;  ///< Along z.

  double pitch_radius() const { return module * teeth / 2; }
};

/// A tooth's outline about the x axis, counter-clockwise: from its root on the right to its root on the left.
inline Profile tooth_outline(const Gear& gear) {
  const double pressure = 20 * kTurn / 360;
  const double pitch = gear.pitch_radius(), base = pitch * std::cos(pressure);
  const double tip = pitch + gear.module, root = pitch - 1.25 * gear.module;
  const auto involute = [](double angle) { return std::tan(angle) - angle; };
  const double half_at_pitch = kTurn / 4 / gear.teeth - gear.backlash / 2 / pitch;
  const auto half_angle = [&](double radius) {
    return half_at_pitch + involute(pressure) - involute(std::acos(std::min(1.0, base / radius)));
  };
  std::vector<ProfilePoint> right;  // (radius, angle below the tooth's middle)
  // The root is a little wider than the flank's foot, as a fillet makes it: no two corners are on one radius.
  if (root < base) right.push_back({root, 0.9 * half_angle(base) + 0.1 * kTurn / 2 / gear.teeth});
  const double foot = std::max(root, base);
  for (std::uint32_t k = 0; k < gear.points; ++k) {
    const double radius = foot + (tip - foot) * k / (gear.points - 1);
    right.push_back({radius, half_angle(radius)});
  }
  Profile outline;
  for (const ProfilePoint& p : right) outline.push_back({p.x * std::cos(p.y), -p.x * std::sin(p.y)});
  for (auto p = right.rbegin(); p != right.rend(); ++p)
    outline.push_back({p->x * std::cos(p->y), p->x * std::sin(p->y)});
  return outline;
}

/// The gear as a closed mesh, the middle of a tooth on the x axis. The fans between rim and bore are slivers, as CAD
/// tessellators make them.
inline TriangleMesh gear_mesh(const Gear& gear) {
  const Profile tooth = tooth_outline(gear);
  Profile rim, bore;
  for (std::uint32_t t = 0; t < gear.teeth; ++t) {
    const double turn = kTurn * t / gear.teeth, c = std::cos(turn), s = std::sin(turn);
    for (std::size_t k = 0; k < tooth.size(); ++k) {
      rim.push_back({c * tooth[k].x - s * tooth[k].y, s * tooth[k].x + c * tooth[k].y});
      const double angle = turn + std::atan2(tooth[k].y, tooth[k].x);
      bore.push_back({gear.bore * std::cos(angle), gear.bore * std::sin(angle)});
    }
  }
  return extruded_band(rim, bore, true, 0, gear.width, gear.layers);
}

}  // namespace dismantle::scenes
