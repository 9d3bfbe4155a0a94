// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/exec/executor.h"
#include "dismantle/geometry/aabb.h"

namespace dismantle {

/// The boxes of the triangles to build a hierarchy over [mm, assembly frame], component after component.
struct BvhInput {
  Span<const Aabb> triangle_boxes;            ///< Shape [triangle_count].
  Span<const std::uint32_t> component_begin;  ///< Shape [component_count + 1]: component c's triangles are
                                              ///< [component_begin[c], component_begin[c + 1]).
};

/// Depth of a component's subtree from which on ranges are halved instead of cut by the surface area heuristic, so that
/// no subtree is deeper than this plus log2 of its triangles.
inline constexpr int kBvhHeuristicDepth = 40;

/// Builds the hierarchy top-down by the binned surface area heuristic, each component by itself, then a tree over the
/// components. The result depends on the input alone: every executor builds the same one.
/// @pre fewer than 2^31 triangles; boxes are finite
Bvh bvh_build(const BvhInput& input, const Executor& executor);

}  // namespace dismantle
