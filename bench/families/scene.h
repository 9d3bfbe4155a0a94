// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/rigid_transform.h"

#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle::families {

/// A part of a scene.
struct Part {
  std::string name;
  TriangleMesh mesh;   ///< In the assembled state [mm].
  bool solid = true;   ///< Closed but for cracks.
  bool simple = true;  ///< Does not intersect itself.
};

/// Two or three parts, and how the first of them is driven.
struct Scene {
  std::vector<Part> parts;  ///< The first one moves.
  double tolerance = 0.01;  ///< [mm]
  Vec3 toward;              ///< Unit direction in which it meets the others.
  double gap = 0;           ///< About how far away they are in that direction [mm]; below 0 where they overlap.
  double size = 1;          ///< Of the moving part [mm].
  std::vector<Vec3> exits;  ///< Unit directions in which it may come off.
  double sagittas = 0;      ///< The sum of those of two coaxial cylinders, one in the other [mm].
};

/// The families, in the order of make_scene().
inline constexpr std::string_view kFamilies[] = {"needles", "cones",  "knives", "spikes",      "rods",    "sheets",
                                                 "foils",   "cracks", "shells", "blind_holes", "tumbling"};
inline constexpr std::size_t kFamilyCount = std::size(kFamilies);

/// A random member of a family; the same for the same state of `random`.
Scene make_scene(std::size_t family, std::mt19937_64& random);

/// Numbers from a generator.
struct Dice {
  std::mt19937_64& random;
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  /// Log-uniform. @pre 0 < low < high
  double spread(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }
  bool chance(double share) { return uniform(0, 1) < share; }
  Vec3 direction() {
    for (;;) {
      const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
      const double l = length(Vec3{x, y, z});
      if (l > 0.1 && l <= 1) return Vec3{x, y, z} / l;
    }
  }
};

}  // namespace dismantle::families
