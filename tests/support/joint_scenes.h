// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "tests/fasteners/turned_meshes.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// Small products that are held together by M5 screws, z up. Threads are drawn as cylinders.
namespace dismantle::scenes {

inline constexpr double kTapped = 2.52;  ///< Radius of a hole with a thread [mm].
inline constexpr double kClear = 2.75;   ///< Radius of a clearance hole [mm].

inline Outline square(double half) {
  return [half](double angle) { return half / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle))); };
}

/// A prism about z with a round hole through it.
inline TriangleMesh bored(const Outline& outer, double hole, double z0, double z1) {
  return turned({{z0, outer}, {z1, outer}, {z1, circle(hole)}, {z0, circle(hole)}}, false);
}

/// A socket head screw M5 whose head rests on z = 0.
inline TriangleMesh m5_screw(double length) {
  return screw(5, length, circle(4.25), 5, hexagon(4), 2.5);
}

/// Solids in one mesh.
inline TriangleMesh joined(const std::vector<TriangleMesh>& solids) {
  TriangleMesh all;
  for (const TriangleMesh& solid : solids) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), solid.vertices.begin(), solid.vertices.end());
    for (const Face& f : solid.faces) all.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
  }
  return all;
}

/// A square slab of 40 mm with a hole in each of its corners, at (+-15, +-15).
inline TriangleMesh four_hole_slab(double hole, double z0, double z1) {
  std::vector<TriangleMesh> solids{box({-10, -20, z0}, {10, 20, z1}), box({-20, -10, z0}, {-10, 10, z1}),
                                   box({10, -10, z0}, {20, 10, z1})};
  for (const double x : {-15.0, 15.0})
    for (const double y : {-15.0, 15.0}) solids.push_back(moved(bored(square(5), hole, z0, z1), {{x, y, 0}, {}}));
  return joined(solids);
}

/// "case" with four tapped corners, a "cover" on it, "screw", "screw#2" ... in the corners, and a "chip" inside that is
/// smaller than a screw, and that a slot in the wall at +x would let out at any time.
inline Assembly covered_case() {
  std::vector<TriangleMesh> solids{box({-20, -20, -4}, {20, 20, 0}), box({-10, -20, 0}, {10, -10, 20}),
                                   box({-10, 10, 0}, {10, 20, 20}), box({-20, -10, 0}, {-10, 10, 20}),
                                   box({10, -10, 8}, {20, 10, 20})};
  for (const double x : {-15.0, 15.0})
    for (const double y : {-15.0, 15.0}) solids.push_back(moved(bored(square(5), kTapped, 0, 20), {{x, y, 0}, {}}));
  std::vector<Component> parts{component("case", joined(solids)), component("cover", four_hole_slab(kClear, 20, 24)),
                               component("chip", box({-2, -2, 0}, {2, 2, 2}))};
  const Component screw = component("screw", m5_screw(16));
  for (int k = 0; k < 4; ++k) {
    parts.push_back(screw);
    if (k > 0) parts.back().name += "#" + std::to_string(k + 1);
    parts.back().assembly_from_mesh.translation = {k % 2 == 0 ? -15.0 : 15.0, k < 2 ? -15.0 : 15.0, 24};
  }
  return assembly(std::move(parts));
}

/// "upper" on "lower", both with clearance holes, with a bolt M5x20, a washer on either side and a nut below:
///
///          [bolt]          z 5 to 8.5
///          washer          z 4 to 5
///     ===== upper =====    z 0 to 4
///     ===== lower =====    z -4 to 0
///          washer#2        z -5 to -4
///           nut            z -9.7 to -5; the bolt ends at -15
inline Assembly bolted_plates() {
  const TriangleMesh washer = bored(circle(5), 2.65, 4, 5);
  TriangleMesh bolt = screw(5, 20, hexagon(8), 3.5);
  for (Vec3& p : bolt.vertices) p.z += 5;
  TriangleMesh lower_washer = washer;
  for (Vec3& p : lower_washer.vertices) p.z -= 9;
  return assembly({component("lower", bored(square(20), kClear, -4, 0)),
                   component("upper", bored(square(15), kClear, 0, 4)), component("bolt", bolt),
                   component("washer", washer), component("washer#2", lower_washer),
                   component("nut", bored(hexagon(8), kTapped, -9.7, -5))});
}

/// The same, where the nut is a lock nut: a "ring" in a wider hole at its lower end grips the bolt.
inline Assembly bolted_plates_with_lock_nut() {
  Assembly a = bolted_plates();
  a.components[5] =
      component("nut", joined({bored(hexagon(8), kTapped, -8.2, -5), bored(hexagon(8), 3.2, -9.7, -8.2)}));
  a.components.push_back(component("ring", bored(circle(3.2), 2.4, -9.7, -8.2)));
  return a;
}

/// A "plate" that hangs below a "beam" from six screws, "screw", "screw#2" ..., with their heads down.
inline Assembly hanging_plate() {
  std::vector<TriangleMesh> beam, plate;
  std::vector<Component> screws;
  const Component screw = component("screw", moved(m5_screw(16), {{}, quat_about({1, 0, 0}, kTurn / 2)}));
  for (int k = 0; k < 6; ++k) {
    const Vec3 at{15.0 * (k % 3 - 1), k < 3 ? -7.5 : 7.5, 0};
    beam.push_back(moved(bored(square(7.5), kTapped, 4, 30), {at, {}}));
    plate.push_back(moved(bored(square(7.5), kClear, 0, 4), {at, {}}));
    screws.push_back(screw);
    if (k > 0) screws.back().name += "#" + std::to_string(k + 1);
    screws.back().assembly_from_mesh.translation = at;
  }
  std::vector<Component> parts{component("beam", joined(beam)), component("plate", joined(plate))};
  parts.insert(parts.end(), screws.begin(), screws.end());
  return assembly(std::move(parts));
}

}  // namespace dismantle::scenes
