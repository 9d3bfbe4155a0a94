// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Closed walks along the edges that the surface does not run along equally often in both directions, each edge as
/// often and in the direction in which it is in excess: where the surface ends. Empty for a surface without such edges,
/// of which every component bounds a volume. A walk visits a vertex once. Where several edges go on from a vertex, a
/// walk takes the one that turns back the most: a long edge with a row of short ones along its other side
/// (T-junctions) makes a narrow loop of its own. @return vertex indices; each walk goes on from its last vertex to its
/// first
std::vector<std::vector<std::uint32_t>> boundary_loops(const TriangleMesh& mesh);

}  // namespace dismantle
