// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/motion/motion_span.h"
#include "dismantle/audit/sweep_triangles.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle::audit {

/// A run of segments.
struct SegmentRun {
  std::uint32_t first = 0;  ///< Index of the first segment.
  std::uint32_t count = 0;  ///< Number of segments.
};

/// The runs of segments in which a body turns about one axis at one pitch, by at least two radians; in order.
/// @param tolerance largest difference of the motions of a point that counts as the same motion [mm per rad]
std::vector<SegmentRun> helical_runs(const std::vector<MotionSegment>& segments, const AuditBody& body,
                                     double tolerance);

/// One helical motion of b relative to a through a run of segments.
struct HelicalMotion {
  SegmentRun run;              ///< Its segments.
  Vec3 origin;                 ///< A point of the axis [mm, frame of a].
  Mat3 frame;                  ///< Rows: two directions perpendicular to the axis, and the axis, in the frame of a.
  double pitch = 0;            ///< Advance along the axis [mm per rad].
  std::vector<double> angles;  ///< Angle of b at the start of each segment of the run, and at the end [rad].
  double deviation = 0;        ///< Largest distance of a point of b from this motion [mm].

  /// A point of a's frame in the coordinates of `frame` about `origin` [mm].
  Vec3 axis_coordinates(Vec3 x_a) const { return frame * (x_a - origin); }
};

/// The motion of a pair in a run of helical_runs(); nothing where its deviation is above the resolution.
std::optional<HelicalMotion> helical_motion(const PairSweep& pair, const SegmentRun& run);

}  // namespace dismantle::audit
