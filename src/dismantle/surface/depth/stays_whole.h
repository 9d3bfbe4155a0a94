// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/surface/solid_shape.h"

namespace dismantle {

/// True if each connected part of a surface stays in one piece, or is gone, where another solid is cut out of it: a
/// plate stays in one piece where a pin goes through it, and the pin does not where the plate is cut out of the pin.
/// Faces across the surface of the other solid are divided; what is thinner than `finest` may be overlooked, and a
/// piece counts as whole then.
/// @param vertices, faces a mesh whose faces share vertices [mm, assembled] @param cutter the other solid, in the same
/// frame @param finest edges are not divided further [mm]
bool stays_whole(Span<const Vec3> vertices, Span<const Face> faces, const SolidShape& cutter, double finest);

}  // namespace dismantle
