// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace dismantle {

/// The goal of simplify_mesh(): it stops at whichever is reached first.
struct SimplifyGoal {
  std::size_t triangles = 0;                               ///< Number of triangles.
  double error = std::numeric_limits<double>::infinity();  ///< Largest quadric error of a collapse [mm].
};

/// Simplifies a mesh by edge collapses in the order of the quadric error metric: the paper's QSlim step, with the
/// properties of EdgeCollapse. The quadric error is an estimate of the change; hausdorff_distance() bounds it.
///
/// A closed, consistently oriented mesh of positive volume keeps at least half of it: the count remains above the goal
/// where fewer triangles would lose more, or where topology forbids more collapses. Returns the mesh itself where it
/// has no more triangles than the goal.
TriangleMesh simplify_mesh(const TriangleMesh& mesh, const SimplifyGoal& goal);

/// The state of a mesh after a number of collapses.
struct SimplificationStep {
  std::size_t triangles = 0;  ///< Number of triangles.
  double error = 0;           ///< Largest quadric error so far [mm].
};

/// The states from the whole mesh to the last possible collapse: numbers of triangles decrease, errors do not.
std::vector<SimplificationStep> simplification_curve(const TriangleMesh& mesh);

}  // namespace dismantle
