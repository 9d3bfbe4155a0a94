// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/features/thread_axes.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

/// A point of a surface with the normal and the area that it stands for.
struct SurfaceSample {
  Vec3 point;       ///< [mm]
  Vec3 normal;      ///< Unit.
  double area = 0;  ///< [mm^2]
};

/// Samples the smooth parts of a mesh at the edges between two faces of interest. The mean normal of two neighbours is
/// near the smooth surface's, that of a single face is not.
/// @param of_interest not 0 for the faces to sample; shape [face_count]
std::vector<SurfaceSample> smooth_samples(const TriangleMesh& mesh, Span<const std::uint8_t> of_interest);

/// Samples the smooth and curved parts of a mesh at the edges between their faces, evenly spaced in the order of edges
/// so that there are at most about `max_count`.
std::vector<SurfaceSample> curved_samples(Span<const Vec3> vertices, Span<const Face> faces, std::size_t max_count);

/// The thread that most of the samples lie on: axis, lead and extent, but no flanks, and one start. Other surfaces
/// among the samples (seats, ends, chamfers) do no harm if they are fewer. It needs no edges along helices, as
/// thread_axes does, so it also works on remeshed surfaces. The twist whose velocities along the sampled normals are
/// smallest is a linear problem (Pottmann, Randrup 1998: rotational and helical surface approximation for reverse
/// engineering). Nothing if a plain rotation or translation fits as well.
std::optional<ThreadAxis> fit_thread(Span<const SurfaceSample> samples);

}  // namespace dismantle
