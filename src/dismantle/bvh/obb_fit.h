// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/obb.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>

namespace dismantle {

/// A box around the listed triangles, relative to `origin`, along the principal axes of their surface (Gottschalk, Lin,
/// Manocha 1996); one triangle's box lies along its longest edge. Certainly contains them, despite float32.
/// @param order indices of faces, not empty
Obb obb_fit(Span<const Vec3> vertices, Span<const Face> faces, Span<const std::uint32_t> order, Vec3 origin);

/// An upper bound of the distance from the box's center to any of its points [mm].
float obb_radius(const Obb& box);

}  // namespace dismantle
