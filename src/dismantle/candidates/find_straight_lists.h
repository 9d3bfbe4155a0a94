// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/candidates/candidate_kernel.h"
#include "dismantle/exec/executor.h"

#include <vector>

namespace dismantle {

/// StraightLists and what they hold.
struct FoundStraightLists {
  std::vector<NearLeaves> near;  ///< As StraightLists::near.
  std::vector<FarNodes> far;     ///< As StraightLists::far.
};

/// How many leaves are listed [pairs]; what is beyond is searched by every candidate.
struct NearLimits {
  std::size_t most = 1 << 18;   ///< In all.
  std::size_t apart = 1 << 10;  ///< Of those that do not overlap at the start, and half as many more as do.
};

/// Finds the lists of a state. @param scene in host memory
FoundStraightLists find_straight_lists(const CandidateScene& scene, const Executor& executor,
                                       const NearLimits& limits = {});

}  // namespace dismantle
