// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/obb.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>

namespace dismantle {

/// Fits a box to triangles along the principal axes of their surface (Gottschalk, Lin, Manocha 1996), or along the
/// longest edge of a single triangle. It certainly contains them, despite float32.
/// @param order indices of the faces, not empty
/// @param origin that the box is relative to [mm]
Obb obb_fit(Span<const Vec3> vertices, Span<const Face> faces, Span<const std::uint32_t> order, Vec3 origin);

/// Fits a box with the axes of another one, as obb_fit() does otherwise.
Obb obb_fit_along(const Obb& like, Span<const Vec3> vertices, Span<const Face> faces, Span<const std::uint32_t> order,
                  Vec3 origin);

/// An upper bound of the distance from the box's center to any of its points [mm].
float obb_radius(const Obb& box);

}  // namespace dismantle
