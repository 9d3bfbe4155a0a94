// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"
#include "dismantle/surface/solid_tree.h"

#include <limits>

namespace dismantle {

/// The nearest triangles of two components.
struct SolidDistance {
  double distance = std::numeric_limits<double>::infinity();  ///< 0 where surfaces meet, infinite where none is found.
  FaceId face_a, face_b;                                      ///< Of the components' own meshes.
  Vec3 point_a, point_b;                                      ///< [mm, world]
};

/// A component's tree and where it is.
struct PlacedSolid {
  const SolidTree* solid = nullptr;
  RigidTransform world_from_assembled;
};

/// A lower bound of the distance of two components, from the roots of their trees alone [mm]. @pre neither is empty
double bounds_distance(const PlacedSolid& a, const PlacedSolid& b);

/// The nearest triangles of two components, if they are nearer than `limit` [mm]: by branch and bound over both trees,
/// the nearer boxes first. As exact as distance_triangle_triangle; of equally near pairs always the same one.
/// @pre neither is empty
SolidDistance solid_distance(const PlacedSolid& a, const PlacedSolid& b,
                             double limit = std::numeric_limits<double>::infinity());

}  // namespace dismantle
