// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/math/vec3.h"

#include <cstdint>

namespace dismantle {

/// Which rule of the guarantee (docs/guarantee.md) a pair of triangles would break further on.
enum class BlockingRule : std::uint8_t {
  Triangles,  ///< The triangles would get deeper into each other than their pair is allowed.
  VertexOfA,  ///< A vertex of `face_a` would get too deep behind `face_b`.
  VertexOfB,  ///< A vertex of `face_b` would get too deep behind `face_a`.
};

/// Two triangles of different components that block a motion.
struct BlockingPair {
  ComponentId a, b;       ///< a < b
  FaceId face_a, face_b;  ///< Faces of the components' own meshes.
  double toi = 0;         ///< The pair certainly allows the motion on [0, toi] (ElementaryTest::Elementary: the root).
  BlockingRule rule = BlockingRule::Triangles;
  friend bool operator==(const BlockingPair&, const BlockingPair&) = default;
};

/// A point where the moving set touches another component.
struct ContactPoint {
  ComponentId moving, fixed;       ///< A component of the moving set, and the other one.
  FaceId face_moving, face_fixed;  ///< Faces of the components' own meshes.
  Vec3 point;                      ///< On the moving face [mm, world].
  Vec3 normal;                     ///< Unit vector from the fixed component to the moving one [world].
  double gap = 0;                  ///< Along the normal [mm]; negative where the faces overlap.
  friend bool operator==(const ContactPoint&, const ContactPoint&) = default;
};

/// The first contact of a candidate motion, which is not carried out.
struct FirstContact {
  double toi = 1;                  ///< The motion is certainly free on [0, toi]; 1 if all of it is.
  bool free = true;                ///< Nothing blocks the motion.
  ComponentId moving, fixed;       ///< The components of the earliest contact; meaningless if free.
  FaceId face_moving, face_fixed;  ///< Its faces, of the components' own meshes; meaningless if free.
  friend bool operator==(const FirstContact&, const FirstContact&) = default;
};

}  // namespace dismantle
