// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/motion/relative_motion.h"
#include "dismantle/geometry/triangle.h"

#include <cstdint>

namespace dismantle::audit {

/// A time interval of one segment, with the poses at its ends.
struct TimeSlice {
  std::uint32_t segment = 0;               ///< Index of the segment.
  double from = 0;                         ///< Begin, in [0, 1] of the segment.
  double to = 1;                           ///< End, in [0, 1] of the segment.
  RigidTransform start;                    ///< Pose of the body that moves at the begin, in the frame of the other.
  RigidTransform end;                      ///< Pose at the end.
  const RelativeMotion* motion = nullptr;  ///< Of the segment; never null.

  /// The middle, in [0, 1] of the segment.
  double middle() const { return (from + to) / 2; }
};

/// A part of a triangle of one body during a time slice, in the frame of the other. Its points move on chords: a point
/// of the body is never further than `deviation` from the place where it would be then.
struct SurfacePiece {
  Triangle body;         ///< Its corners in the frame of their body [mm].
  Vec3 corner[6];        ///< The corners at the begin and at the end [mm].
  Vec3 center;           ///< Their mean [mm].
  double radius = 0;     ///< Largest distance of one of them from the centre, with the deviation [mm].
  double movement = 0;   ///< Longest chord [mm].
  double deviation = 0;  ///< Bound of the distance of arcs from chords, at equal times [mm].
};

/// A part of a triangle in a time slice.
inline SurfacePiece make_piece(const TimeSlice& slice, const Triangle& body) {
  SurfacePiece piece;
  piece.body = body;
  const double duration = slice.to - slice.from;
  double acceleration = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 from = slice.start * body[k], to = slice.end * body[k];
    piece.corner[k] = from;
    piece.corner[k + 3] = to;
    piece.center += (from + to) / 6.0;
    piece.movement = max(piece.movement, length(to - from));
    if (slice.motion->screw.angle > 0)
      acceleration = max(acceleration, slice.motion->acceleration(slice.motion->velocity(from)));
  }
  // The acceleration towards the axis is largest at a corner, and a chord is at most h^2 |acceleration| / 8 off.
  piece.deviation = acceleration * duration * duration / 8;
  for (const Vec3& p : piece.corner) piece.radius = max(piece.radius, length(p - piece.center));
  piece.radius += piece.deviation;
  return piece;
}

}  // namespace dismantle::audit
