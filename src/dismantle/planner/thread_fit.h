// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

/// A piece of a surface.
struct SurfaceSample {
  Vec3 point;       ///< [mm]
  Vec3 normal;      ///< Unit.
  double area = 0;  ///< [mm^2]
};

/// The smooth parts of a mesh, at the edges of two faces that both are of interest: a face by itself leans to one side
/// of where it is, two next to each other do not.
/// @param of_interest shape [face_count]
std::vector<SurfaceSample> smooth_samples(const TriangleMesh& mesh, Span<const std::uint8_t> of_interest);

/// A screw motion that takes a surface along itself.
struct Thread {
  Vec3 point;         ///< On the axis, nearest to the middle of the surface [mm].
  Vec3 axis;          ///< Unit, of either sign.
  double rise = 0;    ///< Along the axis for a turn by one radian [mm]; above 0: a right-handed thread.
  double radius = 0;  ///< Of the surface about the axis, in the mean [mm].
};

/// The thread that these pieces of flanks are of, if they are of one: axis, pitch and hand, whatever the profile, and
/// whatever else is among them as long as it is less (seats, ends, chamfers). A surface goes along itself by a screw
/// motion where no normal has a part of its velocity; that is linear in the motion (Pottmann, Randrup 1998: rotational
/// and helical surface approximation for reverse engineering). Nothing where a plain turn or shift does it as well.
std::optional<Thread> fit_thread(Span<const SurfaceSample> samples);

}  // namespace dismantle
