// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/motion/helical_motion.h"
#include "dismantle/audit/profile_tree.h"
#include "dismantle/audit/sweep_triangles.h"

#include <optional>

namespace dismantle::audit {

/// A pair in a helical motion, with the profiles of both bodies about its axis.
struct HelicalPair {
  HelicalMotion motion;  ///< Of b relative to a.
  ProfileFrame frame;    ///< Directions of the profiles.
  ///@{ Profiles in the frame of a, that of b at the start of the run.
  ProfileTree a, b;
  ///@}
};

/// The profiles of a pair in a run; nothing where it does not follow one helical motion there. @pre neither is empty
std::optional<HelicalPair> helical_pair(const PairSweep& pair, const SegmentRun& run);

/// As sweep_triangles(), for at most kSpanSegments segments of the pair's run. Triangles whose profiles are apart are
/// apart at all times; the others are checked only at the times at which they pass each other.
TriangleFindings sweep_helix(const PairSweep& pair, const HelicalPair& helical, const SegmentRun& segments);

}  // namespace dismantle::audit
