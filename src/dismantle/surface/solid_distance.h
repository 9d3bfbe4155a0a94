// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"
#include "dismantle/surface/solid_tree.h"

#include <cmath>
#include <limits>

namespace dismantle {

/// Distance of two components and the nearest triangles.
struct SolidDistance {
  /// Distance [mm]: 0 where the surfaces intersect or touch, infinite where none below the limit was found.
  double distance = std::numeric_limits<double>::infinity();
  FaceId face_a;  ///< Nearest face in the mesh of `a`.
  FaceId face_b;  ///< Nearest face in the mesh of `b`.
  Vec3 point_a;   ///< Nearest point of `a` [mm, world frame].
  Vec3 point_b;   ///< Nearest point of `b` [mm, world frame].
};

/// A component's tree at a pose.
struct PlacedSolid {
  const SolidTree* solid = nullptr;     ///< Never null.
  RigidTransform world_from_assembled;  ///< The pose.
};

/// A lower bound of the distance of two components from the root boxes of their trees [mm]. @pre neither is empty
double bounds_distance(const PlacedSolid& a, const PlacedSolid& b);

/// The distance of two components where it is below `limit` [mm]: branch and bound over both trees, the nearer boxes
/// first. As exact as distance_triangle_triangle(); of several pairs at the same distance always the same is returned.
/// @pre neither is empty
SolidDistance solid_distance(const PlacedSolid& a, const PlacedSolid& b,
                             double limit = std::numeric_limits<double>::infinity());

/// The limit at which solid_distance() finds every distance of at most `distance` [mm].
inline double limit_including(double distance) {
  return std::nextafter(distance, std::numeric_limits<double>::infinity());
}

}  // namespace dismantle
