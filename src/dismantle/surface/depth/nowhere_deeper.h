// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_shape.h"

namespace dismantle {

/// True if no point inside a solid is further from its surface than `limit` [mm]: a ball of that radius fits nowhere.
/// Branch and bound over boxes: the distance from one triangle is convex, so that no point of a box is further from the
/// surface than its farthest corner is from any one triangle. False for meshes with holes, and where the largest ball
/// is so little smaller than `limit` that the search is given up.
bool is_nowhere_deeper(const SolidShape& solid, double limit);

}  // namespace dismantle
