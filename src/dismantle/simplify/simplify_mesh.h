// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace dismantle {

/// When simplify_mesh stops: at whichever comes first.
struct SimplifyGoal {
  std::size_t triangles = 0;                               ///< So few triangles.
  double error = std::numeric_limits<double>::infinity();  ///< The next collapse's quadric error would be larger [mm].
};

/// Fewer triangles by edge collapses in the order of the quadric error metric: the paper's QSlim step, with the
/// properties of EdgeCollapse. How far the surface moved is what hausdorff_distance tells; the quadric error is an
/// estimate.
///
/// A closed, consistently oriented mesh of positive volume keeps at least half of it, or less is collapsed. The count
/// may stay above the goal for that reason, or because topology forbids more collapses. Gives the mesh itself where it
/// has no more triangles than the goal.
TriangleMesh simplify_mesh(const TriangleMesh& mesh, const SimplifyGoal& goal);

/// What simplify_mesh has to give for a mesh: so many triangles at that quadric error.
struct SimplificationStep {
  std::size_t triangles = 0;
  double error = 0;  ///< [mm]
};

/// The triangles and the error after each collapse, from the whole mesh to the end: triangles fall, errors do not.
std::vector<SimplificationStep> simplification_curve(const TriangleMesh& mesh);

}  // namespace dismantle
