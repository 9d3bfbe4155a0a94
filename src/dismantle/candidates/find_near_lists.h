// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/candidates/candidate_kernel.h"
#include "dismantle/exec/executor.h"

#include <vector>

namespace dismantle {

/// NearLists and what they hold.
struct FoundNearLists {
  ///@{ As NearLists has them.
  std::vector<NearLeaves> near;
  std::vector<NearNormals> normals;
  std::vector<NearLevels> levels;
  std::vector<FarNodes> far;
  ///@}
};

/// How many leaves are listed [pairs]; what is beyond is searched by every candidate.
struct NearLimits {
  std::size_t most = 1 << 18;   ///< In all.
  std::size_t apart = 1 << 10;  ///< Of those that do not overlap at the start, and half as many more as do.
};

/// Finds the lists of a state. @param scene in host memory
FoundNearLists find_near_lists(const CandidateScene& scene, const Executor& executor, const NearLimits& limits = {});

}  // namespace dismantle
