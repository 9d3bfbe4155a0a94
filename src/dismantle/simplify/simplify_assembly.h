// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"
#include "dismantle/simplify/hausdorff_distance.h"

#include <cstddef>
#include <vector>

namespace dismantle {

/// Smallest target of a component: the number of triangles of a tube with three sides, the simplest closed shape of a
/// part with a hole.
inline constexpr std::size_t kMinimumComponentTriangles = 24;

/// Options of simplify_assembly().
struct SimplifyOptions {
  std::size_t minimum_triangles = kMinimumComponentTriangles;  ///< Of a component; smaller ones are not changed.
  Executor executor;                                           ///< Runs the meshes; the result does not depend on it.
  ProgressCallback progress;                                   ///< Returning false cancels.
};

/// The simplification of one component.
struct ComponentSimplification {
  std::size_t triangles_before = 0;  ///< Of its original mesh.
  std::size_t triangles_after = 0;   ///< Of its simplified mesh.
  DistanceBounds error;              ///< Hausdorff distance of the two: `upper` is certain [mm].
};

/// A simplified assembly: the same components with the same names, order and poses.
struct SimplifiedAssembly {
  Assembly assembly;  ///< Its simplification_error has grown by the largest upper bound of a component's error.
  std::vector<ComponentSimplification> components;  ///< In the assembly's order.
};

/// Simplifies each component's mesh by itself (simplify_mesh()) so that the assembly has about `target_triangles`. The
/// target is distributed by error: one error is searched for the whole assembly, and collapses of a component stop at a
/// part of it in proportion to the square root of the component's size; no component's target is below the minimum. The
/// total remains above the target where minima and topology require it. Instances share their simplified mesh. The
/// result depends on the arguments alone. Errors: Failed where `progress` cancelled.
Result<SimplifiedAssembly> simplify_assembly(const Assembly& assembly, std::size_t target_triangles,
                                             const SimplifyOptions& options = {});

}  // namespace dismantle
