// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/revolution_axes.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// A unit direction in the profile plane of a thread, whose coordinates are (distance from the axis, axial offset).
struct ProfileDirection {
  double radial = 0;  ///< Component away from the axis.
  double axial = 1;   ///< Component along the axis.
};

/// A screw thread of a surface, outer or inner. The axial offset of a point is its position along the axis less the
/// lead times its angle in turns. The screw motion of the thread changes neither a point's distance from the axis nor
/// its axial offset: in these two coordinates the thread is its profile.
struct ThreadAxis {
  Vec3 point;             ///< On the axis [mm].
  Vec3 direction;         ///< Unit.
  double lead = 0;        ///< Advance along `direction` per turn: above 0 for a right-handed thread [mm].
  int starts = 1;         ///< Number of ridges side by side: the profile repeats after |lead| / starts.
  double begin = 0;       ///< Start of the flanks along the axis, from `point` [mm].
  double end = 0;         ///< End of the flanks along the axis, from `point` [mm].
  double min_radius = 0;  ///< Smallest distance of the flanks from the axis [mm].
  double max_radius = 0;  ///< Largest distance of the flanks from the axis [mm].

  /// A flank as a line in the profile plane.
  struct Flank {
    ProfileDirection normal;  ///< Outward.
    double offset = 0;        ///< Of the line along the normal; one of those that the profile repeats [mm].
  };
  std::vector<Flank> flanks;  ///< Of one period of the profile.

  /// The sum of the radial components of the flanks' normals: above 0 for an outer thread, below 0 for an inner one.
  double radial_sum() const {
    double radial = 0;
    for (const Flank& flank : flanks) radial += flank.normal.radial;
    return radial;
  }
};

/// The threads of a mesh about some of its axes, at most one about each. They are found by edges along helices, which
/// tessellations of modelled threads have, and by flanks that keep to one line of the profile all around. If there are
/// none, the surface is tested for being invariant under a screw motion (fit_thread), which also finds threads in
/// remeshed surfaces. A heuristic: threads may be missing; they only tell where to look.
std::vector<ThreadAxis> thread_axes(Span<const Vec3> vertices, Span<const Face> faces, Span<const RevolutionAxis> axes);

/// True if two threads are those of a screw and its nut: one outer, one inner, of nearly the same lead, the same number
/// of starts and nearly the same axis.
bool threads_mate(const ThreadAxis& x, const ThreadAxis& y);

/// The longer one of two threads that mate: the axis and the lead of a screw in its nut, which are measured the better
/// the longer the thread is.
const ThreadAxis& better_known(const ThreadAxis& x, const ThreadAxis& y);

/// The part of a thread's profile that each face belongs to: a number for each flank, for the crests and for the roots
/// of each thread; 0 for all other faces. Faces of one number are close together in the profile, wherever they are
/// around the axis. Shape [face_count]; empty if there are no threads.
std::vector<std::uint8_t> thread_parts(Span<const Vec3> vertices, Span<const Face> faces,
                                       Span<const ThreadAxis> threads);

}  // namespace dismantle
