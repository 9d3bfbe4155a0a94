// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/motion/helical_motion.h"
#include "dismantle/audit/solid/depth_search.h"

#include <optional>
#include <vector>

namespace dismantle::audit {

/// The faces of two components that are certainly nowhere deep in the other one.
struct ClearFaces {
  std::vector<bool> of_a;  ///< By face of a.
  std::vector<bool> of_b;  ///< By face of b.
};

/// Finds faces that are no deeper than `limit` in the other component throughout a run of segments in which b makes
/// nearly a helical motion: turns of a thread, which all pass each other in the plane of r and u (ProfileFrame). A face
/// is clear where it, or a copy shifted by no more than the limit, has a profile apart from that of the other
/// component, and is outside at the begin of the run. Nothing where the motion is not helical, or a component not
/// closed.
std::optional<ClearFaces> clear_in_helical_motion(const DepthPair& pair, const SegmentRun& run, double limit);

}  // namespace dismantle::audit
