// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/motion/relative_motion.h"

#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// One screw of a move, from frame to frame. A move ends with a screw of no motion at its last frame, so that every
/// frame is the start of one.
struct MotionSegment {
  std::size_t frame = 0;  ///< The frame it starts at.
  double time = 0;        ///< Of that frame [s].
  double duration = 0;    ///< [s]
  Pose start;
  Screw screw;
};

/// The screws of a move in order; frames that repeat the pose before them are left out, there is nothing new to see.
std::vector<MotionSegment> motion_segments(const std::vector<Frame>& frames);

/// A run of screws and how far a body goes within it: at every instant it is its pose at the frame `middle`, turned by
/// at most `turn` [rad] about its centre, which is moved by at most `shift` [mm].
struct MotionSpan {
  std::uint32_t first = 0, count = 0;  ///< Segments.
  std::uint32_t middle = 0;            ///< The segment at whose start the reference pose is taken.
  std::uint32_t right = 0;             ///< Index of the second half; the first half follows; 0 where count is 1.
  double shift = 0, turn = 0;
};

/// Segments in one tree of spans: what one task looks at.
inline constexpr std::uint32_t kSpanSegments = 32;

/// The tree of spans over segments [first, first + count) for a body that follows them; the root is the first.
/// @pre 0 < count <= kSpanSegments
std::vector<MotionSpan> motion_spans(const std::vector<MotionSegment>& segments, std::uint32_t first,
                                     std::uint32_t count, const AuditBody& body);

}  // namespace dismantle::audit
