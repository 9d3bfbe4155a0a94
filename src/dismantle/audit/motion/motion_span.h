// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/motion/relative_motion.h"

#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// One screw motion of a move, from frame to frame. The last segment of a move is at rest at the last frame, so that
/// every frame is the start of a segment.
struct MotionSegment {
  std::size_t frame = 0;  ///< Index of the frame at its start.
  double time = 0;        ///< Time of that frame [s].
  double duration = 0;    ///< Time to the next frame [s].
  Pose start;             ///< Pose at its start.
  Screw screw;            ///< The motion.
};

/// The segments of a move in order, without those that repeat the pose before them.
std::vector<MotionSegment> motion_segments(const std::vector<Frame>& frames);

/// A node of a tree over segments, with bounds of a body's motion: at every time the body is at its pose at the start
/// of the segment `middle`, turned by at most `turn` about its centre, which is moved by at most `shift`.
struct MotionSpan {
  ///@{ Segments [first, first + count).
  std::uint32_t first = 0, count = 0;
  ///@}
  std::uint32_t middle = 0;  ///< The segment at whose start the reference pose is.
  std::uint32_t right = 0;   ///< Index of the second half, 0 where count is 1; the first half is the next node.
  double shift = 0;          ///< Bound of the centre's displacement [mm].
  double turn = 0;           ///< Bound of the rotation [rad].
};

/// Largest number of segments of one span tree, the unit of work.
inline constexpr std::uint32_t kSpanSegments = 32;

/// The span tree over segments [first, first + count) for a body that follows them; the root is the first.
/// @pre 0 < count <= kSpanSegments
std::vector<MotionSpan> motion_spans(const std::vector<MotionSegment>& segments, std::uint32_t first,
                                     std::uint32_t count, const AuditBody& body);

}  // namespace dismantle::audit
