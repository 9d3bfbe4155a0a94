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
  ComponentId a;   ///< The component with the smaller id.
  ComponentId b;   ///< The other one.
  FaceId face_a;   ///< Face of the mesh of `a`.
  FaceId face_b;   ///< Face of the mesh of `b`.
  double toi = 0;  ///< The pair certainly allows the motion on [0, toi] (ElementaryTest::Elementary: the root).
  BlockingRule rule = BlockingRule::Triangles;  ///< The rule that would be broken.
  friend bool operator==(const BlockingPair&, const BlockingPair&) = default;
};

/// A point where the moving set touches another component.
struct ContactPoint {
  ComponentId moving;  ///< A component of the moving set.
  ComponentId fixed;   ///< The other component.
  FaceId face_moving;  ///< Face of the mesh of `moving`.
  FaceId face_fixed;   ///< Face of the mesh of `fixed`.
  Vec3 point;          ///< On the moving face [mm, world].
  Vec3 normal;         ///< Unit vector from the fixed component to the moving one [world].
  double gap = 0;      ///< Along the normal [mm]; negative where the faces overlap.
  friend bool operator==(const ContactPoint&, const ContactPoint&) = default;
};

/// Two faces of different components that are near each other.
struct NearFaces {
  ComponentId moving;  ///< The component whose neighbours were asked for.
  ComponentId fixed;   ///< The other component.
  FaceId face_moving;  ///< Face of the mesh of `moving`.
  FaceId face_fixed;   ///< Face of the mesh of `fixed`.
  friend bool operator==(const NearFaces&, const NearFaces&) = default;
};

/// The first contact of a candidate motion, which is not carried out.
struct FirstContact {
  double toi = 1;      ///< The motion is certainly free on [0, toi]; 1 if all of it is.
  bool free = true;    ///< Nothing blocks the motion.
  ComponentId moving;  ///< Component of the moving set in the earliest contact; meaningless if free.
  ComponentId fixed;   ///< The other component; meaningless if free.
  FaceId face_moving;  ///< Face of the mesh of `moving`; meaningless if free.
  FaceId face_fixed;   ///< Face of the mesh of `fixed`; meaningless if free.
  friend bool operator==(const FirstContact&, const FirstContact&) = default;
};

/// The part of a motion, after its first contact, whose contacts a sweep reports.
inline constexpr double kContactWindow = 0x1p-10;

}  // namespace dismantle
