// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/geometry/kdop.h"

#include <string>

namespace dismantle {

/// Checks the structure of a hierarchy: every input triangle has one leaf, every node but the root one parent, ranges
/// and post-order are as Bvh says, no node below a component's root belongs to another one.
/// @return the fault in a sentence; empty if there is none
std::string bvh_validate(const Bvh& bvh);

/// As above, and checks that every parent's bounds contain its children's.
std::string bvh_validate(const Bvh& bvh, Span<const Kdop16> bounds);

/// The number of edges of the longest path from the root to a leaf; 0 for an empty hierarchy.
int bvh_depth(const Bvh& bvh);

}  // namespace dismantle
