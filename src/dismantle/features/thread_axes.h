// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/revolution_axes.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// A direction across a thread, in the plane of the distance from its axis and the lift.
struct ProfileDirection {
  double radial = 0, lift = 1;  ///< Of unit length.
};

/// A screw thread of a surface, outer or inner. About its axis a point has a distance, an angle and a place along; its
/// lift is that place less the lead for each turn of the angle. Turned along the thread it keeps its distance and its
/// lift, so that both are all that matters of a surface: its profile.
struct ThreadAxis {
  Vec3 point;                  ///< On the axis [mm].
  Vec3 direction;              ///< Unit.
  double lead = 0;             ///< Along `direction` a turn: above 0 for a right-handed thread [mm].
  int starts = 1;              ///< Equal ridges side by side: the profile repeats after |lead| / starts.
  double begin = 0, end = 0;   ///< Where the flanks are along the axis, from `point` [mm].
  double least = 0, most = 0;  ///< Their distances from the axis [mm].
  struct Flank {
    ProfileDirection normal;  ///< Outward.
    double place = 0;         ///< Of (distance, lift) along the normal; as often as the profile repeats [mm].
  };
  std::vector<Flank> flanks;

  /// Above 0 where the flanks' normals lead away from the axis, as those of an outer thread do; below for an inner one.
  double leaning() const {
    double radial = 0;
    for (const Flank& flank : flanks) radial += flank.normal.radial;
    return radial;
  }
};

/// The threads of a mesh about some of its axes, at most one about each. Found by the edges along helices, as
/// tessellations of modelled threads have them, and by flanks that keep to their place in the profile all around. Where
/// there are none, the one whose surface goes along itself by a screw motion (fit_thread), if most of what is curved
/// does: meshes that were cut anew have no such edges. What is given is only where to look: one may be missing.
std::vector<ThreadAxis> thread_axes(Span<const Vec3> vertices, Span<const Face> faces, Span<const RevolutionAxis> axes);

/// Whether two threads are those of a screw and its nut: one outer, one inner, of nearly the same lead, as many starts
/// and nearly the same axis.
bool threads_mate(const ThreadAxis& x, const ThreadAxis& y);

/// Which part of a thread's profile each face belongs to: a number for each flank, crest and root of each thread; 0 for
/// the rest. Faces of one number lie in a small piece of a profile, wherever they are around the axis. Shape
/// [face_count]; empty where there are no threads.
std::vector<std::uint8_t> thread_parts(Span<const Vec3> vertices, Span<const Face> faces,
                                       Span<const ThreadAxis> threads);

}  // namespace dismantle
