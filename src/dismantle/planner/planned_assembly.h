// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/span.h"
#include "dismantle/planner/shape_features.h"

namespace dismantle {

/// The assembly that a planner works on. Refers to its parts, which must outlive it.
struct PlannedAssembly {
  const Assembly& assembly;            ///< All components in their assembled poses.
  Span<const ShapeFeatures> features;  ///< Of each component, assembled. Shape [component_count].
  double tolerance = 0;                ///< [mm]

  /// Number of components.
  std::size_t size() const { return features.size(); }
};

}  // namespace dismantle
