// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/math/vec3.h"

namespace dismantle {

/// A triangle pair that stops the motion.
struct CollisionContact {
  ComponentId a, b;       ///< a < b
  FaceId face_a, face_b;  ///< Faces of the components' own meshes.
  double toi = 0;         ///< The motion is certainly free up to here (Elementary: up to the root found).
  friend bool operator==(const CollisionContact&, const CollisionContact&) = default;
};

/// Where the set in hand touches the rest, and how.
struct ContactPoint {
  ComponentId moving, fixed;       ///< Of the set in hand, and of the rest.
  FaceId face_moving, face_fixed;  ///< Of the components' own meshes.
  Vec3 point;                      ///< On the moving face [mm, world].
  Vec3 normal;                     ///< Unit, from the fixed component to the moving one [world].
  double gap = 0;                  ///< Along the normal [mm]; below 0 where the faces are in each other.
  friend bool operator==(const ContactPoint&, const ContactPoint&) = default;
};

}  // namespace dismantle
