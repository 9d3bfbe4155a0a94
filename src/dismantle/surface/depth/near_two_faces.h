// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/surface/surface_tree.h"

#include <cstdint>

namespace dismantle {

/// True if all points of the hull of some corners are within a distance of a face of a surface or of one more: a plane
/// divides the hull, and each side of it is within the distance of one of the two. What is half-way between two faces
/// of a plate is within the distance of neither alone. False says nothing.
/// @param corners at least one [mm] @param face the face nearest to the middle of the hull @param limit the distance
/// [mm]
bool near_two_faces(const SurfaceTree& surface, Span<const Vec3> corners, std::uint32_t face, double limit);

}  // namespace dismantle
