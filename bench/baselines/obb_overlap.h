// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/obb.h"
#include "dismantle/math/rigid_transform.h"

namespace dismantle {

/// False only where one of the 15 axes of Gottschalk, Lin, Manocha 1996 separates the boxes.
/// @param a_from_b takes points of b's frame to a's
bool boxes_overlap(const Obb& a, const Obb& b, const RigidTransform& a_from_b);

}  // namespace dismantle
