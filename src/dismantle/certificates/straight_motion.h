// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"
#include "dismantle/surface/solid_tree.h"

#include <optional>

/// Two looks at a solid's way straight past another one that cost a fraction of a sweep and settle most ways.
namespace dismantle {

/// A solid that goes straight, as the one that it goes past sees it.
struct StraightMover {
  const SolidTree& solid;
  RigidTransform at;  ///< Where it begins, from the assembled states of both.
  Vec3 way;           ///< [mm]
};

/// Whether `moving` certainly stays apart from `fixed` as it goes: seen along the way their
/// shadows do not meet, or one is behind the other. False says nothing.
bool passes_by(const StraightMover& moving, const SolidTree& fixed);

/// A vertex that a way straight on takes deep into another solid, or that another solid takes in.
struct DeepVertex {
  double share = 0;  ///< How much of the way it is deep at.
  std::uint32_t face_moving = 0, face_fixed = 0;
  Vec3 point;  ///< Where it is then, as the fixed one sees it [mm].
};

/// Looks whether some vertex gets deeper than `depth` [mm] as `moving` goes, by rays from a few vertices of both. What
/// is found is certain, up to rounding; nothing found says nothing. Only solids that have an outside are looked at.
std::optional<DeepVertex> deep_vertex_on(const StraightMover& moving, const SolidTree& fixed, double depth);

}  // namespace dismantle
