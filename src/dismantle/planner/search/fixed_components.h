// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/rigid_groups.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/shape_features.h"

#include <vector>

namespace dismantle {

/// The components of a body that stay where they are while it is taken apart: those of `fixed` that are in it, or, if
/// none is, the largest one with its group.
/// @param features of all components @param groups of components that move together
ComponentSet fixed_components(const ComponentSet& body, Span<const ComponentId> fixed,
                              const std::vector<ShapeFeatures>& features, const RigidGroups& groups);

}  // namespace dismantle
