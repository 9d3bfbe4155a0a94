// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <cstddef>
#include <limits>

namespace dismantle {

/// When simplify_mesh stops: at whichever comes first.
struct SimplifyGoal {
  std::size_t triangles = 0;                               ///< So few triangles.
  double error = std::numeric_limits<double>::infinity();  ///< The next collapse's quadric error, an estimate [mm].
};

/// Fewer triangles by edge collapses in the order of Garland and Heckbert's quadric error metric (QSlim, 1997; the step
/// that Du et al. 2015 take their test models through), by meshoptimizer. The vertices are vertices of the original;
/// how far the surface moved is what hausdorff_distance tells.
///
/// A mesh that is closed and consistently oriented with positive volume stays so, and keeps at least half of that
/// volume: where collapses would pinch the surface or make a degenerate triangle, its surroundings are left as they
/// were; where that does not help, a less aggressive goal is taken, at worst the original. The count may stay above the
/// goal for that reason, or because topology forbids more collapses. Gives the mesh itself where it has no more
/// triangles than the goal.
TriangleMesh simplify_mesh(const TriangleMesh& mesh, const SimplifyGoal& goal);

/// How many triangles the collapses up to that quadric error leave, about: without simplify_mesh's care for solids.
std::size_t count_simplified(const TriangleMesh& mesh, double error);

}  // namespace dismantle
