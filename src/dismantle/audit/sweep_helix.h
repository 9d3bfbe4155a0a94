// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/motion/helical_motion.h"
#include "dismantle/audit/profile_tree.h"
#include "dismantle/audit/sweep_triangles.h"

#include <optional>

namespace dismantle::audit {

/// A pair in a helical motion: how both look from its axis.
struct HelicalPair {
  HelicalMotion motion;
  ProfileFrame frame;
  ProfileTree a, b;  ///< b where it is at the start of the run.
};

/// Looks at the pair from the axis of a run; nothing where it does not follow one helical motion there. @pre neither is
/// empty
std::optional<HelicalPair> helical_pair(const PairSweep& pair, const SegmentRun& run);

/// As sweep_triangles does, for segments of the pair's run, at most kSpanSegments. Triangles are apart at all times
/// where their profiles are; of the others it is known when they come past each other, and only then they are looked
/// at.
TriangleFindings sweep_helix(const PairSweep& pair, const HelicalPair& helical, const SegmentRun& segments);

}  // namespace dismantle::audit
