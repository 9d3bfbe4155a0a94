// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/candidates/candidate_kernel.h"

#include <vector>

namespace dismantle {

/// StraightLists and what they hold.
struct FoundStraightLists {
  std::vector<NearLeaves> near;  ///< As StraightLists::near.
  std::vector<FarNodes> far;     ///< As StraightLists::far.
};

/// Leaves that are listed at most; what is near beyond it is searched by every candidate [pairs].
inline constexpr std::size_t kMostNearLeaves = 1 << 18;

/// Finds the lists of a state. @param scene in host memory
FoundStraightLists find_straight_lists(const CandidateScene& scene, std::size_t most_near = kMostNearLeaves);

}  // namespace dismantle
