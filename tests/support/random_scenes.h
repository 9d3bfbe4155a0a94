// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/meshes.h"

#include <random>

/// Random small assemblies and motions; the same for the same seed.
namespace dismantle::scenes {

/// Uniform in [-half, half]^3.
inline Vec3 random_vector(std::mt19937_64& random, double half) {
  std::uniform_real_distribution<double> u(-half, half);
  const double x = u(random), y = u(random), z = u(random);
  return {x, y, z};
}

/// A rotation by up to `angle` [rad] about a random axis, and a translation by up to `shift` [mm] per coordinate.
inline Pose random_pose(std::mt19937_64& random, double shift, double angle) {
  std::uniform_real_distribution<double> turn(-angle, angle);
  const Vec3 axis = normalized(random_vector(random, 1) + Vec3{0, 0, 1e-9});
  const double by = turn(random);
  return {random_vector(random, shift), quat_about(axis, by)};
}

/// `count` boxes and tubes of 1-4 mm at random poses in a cube of the given half size.
inline Assembly random_assembly(std::mt19937_64& random, int count, double half) {
  std::vector<Component> components;
  for (int i = 0; i < count; ++i) {
    const Pose pose = random_pose(random, half, 3);
    const double size = 1 + static_cast<double>(random() % 1000) / 333;
    TriangleMesh mesh = i % 2 == 0 ? box({-size / 2, -size / 3, -size / 4}, {size / 2, size / 3, size / 4})
                                   : tube(size / 2, size / 4, -size / 2, size / 2, 12, 2);
    components.push_back(component("part" + std::to_string(i), moved(std::move(mesh), pose)));
  }
  return assembly(std::move(components));
}

}  // namespace dismantle::scenes
