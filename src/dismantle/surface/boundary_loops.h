// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Closed walks along the edges that the surface does not run along equally often in both directions, each edge as
/// often and in the direction in which it is in excess: where the surface ends. Empty for a surface without such edges,
/// of which every component bounds a volume. A walk visits a vertex once. @return vertex indices; each walk goes on
/// from its last vertex to its first
std::vector<std::vector<std::uint32_t>> boundary_loops(Span<const Face> faces);

}  // namespace dismantle
