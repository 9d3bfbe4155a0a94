// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/obb.h"
#include "dismantle/math/rigid_transform.h"

namespace dismantle {

/// True unless one of the 15 axes of Gottschalk, Lin, Manocha 1996 separates the boxes.
/// @param a_from_b maps points from the frame of b to that of a
bool boxes_overlap(const Obb& a, const Obb& b, const RigidTransform& a_from_b);

}  // namespace dismantle
