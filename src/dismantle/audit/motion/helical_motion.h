// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/pair_motion.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle::audit {

/// A run of segments.
struct SegmentRun {
  std::uint32_t first = 0;  ///< Index of the first segment.
  std::uint32_t count = 0;  ///< Number of segments.
};

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

/// The helical motion that is closest to that of a pair in a run of segments; nothing where it turns by less than two
/// radians in all.
/// @param flat an advance along the axis by less than this in all counts as none, and as deviation [mm]
std::optional<HelicalMotion> helical_motion(const PairMotion& pair, const SegmentRun& run, double flat);

}  // namespace dismantle::audit
