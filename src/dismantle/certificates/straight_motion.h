// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"
#include "dismantle/surface/solid_tree.h"

#include <optional>

/// Two tests of the translation of a solid past another one that cost a fraction of a sweep and decide most motions.
namespace dismantle {

/// A solid that is translated, in the frame of the one that it passes.
struct StraightMover {
  const SolidTree& solid;  ///< The solid.
  RigidTransform at;       ///< Its pose at the start, between the assembled states of both.
  Vec3 displacement;       ///< [mm]
};

/// True if `moving` certainly stays apart from `fixed`: projected along the displacement their shadows do not meet, or
/// one is behind the other. False means nothing.
bool passes_by(const StraightMover& moving, const SolidTree& fixed);

/// A vertex that a translation takes deep into another solid, or that another solid receives.
struct DeepVertex {
  double fraction = 0;            ///< Fraction of the displacement at which it is deep.
  std::uint32_t face_moving = 0;  ///< A face of the moving solid: of the vertex, or nearest to it.
  std::uint32_t face_fixed = 0;   ///< The same of the fixed solid.
  Vec3 point;                     ///< Its position then, in the frame of the fixed solid [mm].
};

/// Searches a vertex that gets deeper than `depth` [mm] during the translation, by rays from a few vertices of both. A
/// result is certain up to rounding; no result means nothing. Only for solids that have an outside.
std::optional<DeepVertex> deep_vertex_on(const StraightMover& moving, const SolidTree& fixed, double depth);

}  // namespace dismantle
