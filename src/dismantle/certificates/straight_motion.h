// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"
#include "dismantle/surface/solid_tree.h"

/// A test of the translation of a solid past another one that costs a fraction of a sweep and decides most motions.
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

}  // namespace dismantle
