// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/motion/motion_span.h"
#include "dismantle/audit/pair_motion.h"
#include "dismantle/audit/solid/solid_body.h"

#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// The motion of a component b relative to a component a, for the search for depths.
struct DepthPair {
  ///@{ The components; never null.
  const SolidBody* a = nullptr;
  const SolidBody* b = nullptr;
  ///@}
  PairMotion motion;  ///< Of their surfaces.
};

/// The depths that a search looks for, and the accuracy of its result.
struct DepthGoal {
  double floor = 0;         ///< Depths up to this are not of interest [mm].
  double slack = 0;         ///< How far the result may be below the greatest depth, where that is above the floor [mm].
  double growth = 1;        ///< Factor by which it may be below it in addition; makes a search for great depths cheap.
  bool first_only = false;  ///< Ends at the first sample that is above the floor by more than half the slack.
  std::size_t max_pieces = 0;  ///< Gives up after so many pieces; 0: never.
};

/// A point of one component inside the other.
struct DepthSample {
  double depth = 0;           ///< Its distance from the surface of the other [mm]; 0 for none.
  std::uint32_t segment = 0;  ///< Index of the segment.
  double s = 0;               ///< Time, in [0, 1] of the segment.
  bool of_b = false;          ///< True for a point of b inside a, false for a point of a inside b.
  Vec3 point_a;               ///< Where it is [mm, frame of a].
};

/// The result of a search.
struct DepthFindings {
  DepthSample deepest;      ///< The deepest sample above the floor.
  DepthSample first;        ///< The first sample found above the floor by more than half the slack.
  double bound = 0;         ///< No point is deeper than this [mm], if the search is complete.
  bool complete = false;    ///< False where it gave up, or ended at the first sample.
  std::size_t samples = 0;  ///< Number of pieces examined.
};

/// Searches for the deepest point of the surface of one component inside the other, by branch and bound over the
/// surface and time: pieces of triangles in slices of time that are certainly not deeper than the bound are discarded,
/// others are divided. `DepthFindings::bound` is floor + slack, or, where a sample is above floor + slack / 2, the
/// larger of that and growth * deepest + slack / 2.
/// @param spans of motion_spans() @param of_b true for the points of b inside a, false for those of a inside b
/// @param done faces that are known to be no deeper than the floor and the slack and are left out, by index; or empty
DepthFindings search_depth(const DepthPair& pair, const std::vector<MotionSpan>& spans, bool of_b,
                           const DepthGoal& goal, const std::vector<bool>& done = {});

}  // namespace dismantle::audit
