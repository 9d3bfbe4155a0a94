// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/motion/motion_span.h"
#include "dismantle/audit/sweep_triangles.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle::audit {

/// Segments one after another.
struct SegmentRun {
  std::uint32_t first = 0, count = 0;
};

/// The runs of segments in which a body turns about one axis at one pitch, one and the same motion cut by frames, by
/// two radians at least; in order. What is off by no more than `tolerance` [mm] a radian counts as the same.
std::vector<SegmentRun> helical_runs(const std::vector<MotionSegment>& segments, const AuditBody& body,
                                     double tolerance);

/// One helical motion of b against a through many segments: about the axis through `origin`, by `pitch` along it for
/// each radian.
struct HelicalMotion {
  SegmentRun run;
  Vec3 origin;                 ///< On the axis, in the frame of a [mm].
  Mat3 frame;                  ///< Rows: two directions across the axis, and the axis, in the frame of a.
  double pitch = 0;            ///< [mm per rad]
  std::vector<double> turned;  ///< Of the run: how far b has turned at the start of each segment, and at the end [rad].
  double astray = 0;           ///< The points of b are never further from this motion than this [mm].

  /// The place of a point of a's frame: across the axis, and along it.
  Vec3 place(Vec3 x_a) const { return frame * (x_a - origin); }
};

/// The motion of the pair through a run of helical_runs; nothing where it is further astray than the resolution.
std::optional<HelicalMotion> helical_motion(const PairSweep& pair, const SegmentRun& run);

}  // namespace dismantle::audit
