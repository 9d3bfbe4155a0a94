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

/// No component is asked to have fewer triangles: as many as a tube with three sides has, the least closed shape of a
/// part with a hole.
inline constexpr std::size_t kMinimumComponentTriangles = 24;

/// Options of simplify_assembly.
struct SimplifyOptions {
  std::size_t minimum_triangles = kMinimumComponentTriangles;  ///< Of a component; smaller ones stay as they are.
  Executor executor;
  ProgressCallback progress;
};

/// What happened to one component.
struct ComponentSimplification {
  std::size_t triangles_before = 0;
  std::size_t triangles_after = 0;
  DistanceBounds error;  ///< How far its surface moved: `upper` is certain [mm].
};

/// A simplified assembly: the same components under the same names in the same places.
struct SimplifiedAssembly {
  Assembly assembly;  ///< Its simplification_error has grown by the largest upper bound of a component's error.
  std::vector<ComponentSimplification> components;  ///< In their order.
};

/// Simplifies each component's mesh by itself (simplify_mesh), so that the assembly has about `target_triangles`. They
/// are shared out by error: the error at which collapses stop is searched for the whole assembly, a component's being
/// in proportion to the square root of its size; none is asked to have fewer triangles than the minimum. The total
/// stays above the target where minima and topology do not allow it. Instances share their simplified mesh. Same result
/// on every executor. Errors: Failed where `progress` cancelled.
Result<SimplifiedAssembly> simplify_assembly(const Assembly& assembly, std::size_t target_triangles,
                                             const SimplifyOptions& options = {});

}  // namespace dismantle
