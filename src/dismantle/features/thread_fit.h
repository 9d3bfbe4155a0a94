// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/features/thread_axes.h"

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

/// The smooth parts of a mesh that are curved, at the edges between their faces; of more than `most` an even choice.
std::vector<SurfaceSample> curved_samples(Span<const Vec3> vertices, Span<const Face> faces, std::size_t most);

/// The thread that these pieces of flanks are of, if they are of one: axis, lead and where they are, but no profile,
/// and one start. Whatever else is among them (seats, ends, chamfers) may be as long as it is less. It needs no edges
/// along helices, as thread_axes does, so that meshes that were cut anew have it, too; but only flanks, whatever turns
/// in a thread touches. A surface goes along itself by a screw motion where no normal has a part of its velocity; that
/// is linear in the motion (Pottmann, Randrup 1998: rotational and helical surface approximation for reverse
/// engineering). Nothing where a plain turn or shift does it as well.
std::optional<ThreadAxis> fit_thread(Span<const SurfaceSample> samples);

}  // namespace dismantle
