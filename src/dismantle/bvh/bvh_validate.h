// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/geometry/kdop.h"

#include <string>

namespace dismantle {

/// What is wrong with the hierarchy's structure, in a sentence; empty where nothing is: every input triangle has one
/// leaf, every node but the root one parent, ranges and post-order as Bvh says, no node below a component's root
/// belongs to another one.
std::string bvh_validate(const Bvh& bvh);

/// As above, and that every parent's bounds contain its children's.
std::string bvh_validate(const Bvh& bvh, Span<const Kdop16> bounds);

/// The length of the longest way from the root to a leaf, in edges.
int bvh_depth(const Bvh& bvh);

}  // namespace dismantle
