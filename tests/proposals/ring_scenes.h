// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/angle.h"
#include "tests/support/meshes.h"
#include "tests/support/swept_meshes.h"

#include <cmath>

/// Rings and balls.
namespace dismantle::scenes {

inline TriangleMesh shifted(TriangleMesh mesh, Vec3 by) {
  for (Vec3& p : mesh.vertices) p += by;
  return mesh;
}

/// A torus about z.
inline TriangleMesh o_ring(double middle, double section, double z) {
  Profile profile;
  for (int k = 0; k < 16; ++k) {
    const double angle = kTurn * k / 16;
    profile.push_back({middle + section / 2 * std::cos(angle), z + section / 2 * std::sin(angle)});
  }
  return revolved_loop(profile, 48);
}

/// An open ring about z of rectangular section, with a gap [rad].
inline TriangleMesh open_ring(double inner, double outer, double height, double gap) {
  Profile outside, inside;
  for (int k = 0; k <= 40; ++k) {
    const double angle = gap / 2 + (kTurn - gap) * k / 40;
    outside.push_back({outer * std::cos(angle), outer * std::sin(angle)});
    inside.push_back({inner * std::cos(angle), inner * std::sin(angle)});
  }
  return extruded_band(outside, inside, false, 0, height);
}

inline TriangleMesh ball(double radius, Vec3 at) {
  Profile profile;
  for (int k = 0; k <= 12; ++k) {
    const double angle = kTurn * (static_cast<double>(k) / 24 - 0.25);
    profile.push_back({k % 12 == 0 ? 0 : radius * std::cos(angle), radius * std::sin(angle)});
  }
  return shifted(revolved(profile, 16), at);
}

/// A shaft along z of radius 10 with a groove of radius 8.5 from -1 to 1, and an O-ring of 2 mm in it, stretched:
/// it overlaps the groove's floor by 0.05.
inline Assembly ring_in_groove() {
  return assembly(
      {component("shaft",
                 revolved({{0, -20}, {10, -20}, {10, -1}, {8.5, -1}, {8.5, 1}, {10, 1}, {10, 20}, {0, 20}}, 48)),
       component("seal", o_ring(9.45, 2, 0))});
}

}  // namespace dismantle::scenes
