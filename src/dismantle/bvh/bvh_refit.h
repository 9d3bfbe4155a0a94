// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh_refit_kernel.h"
#include "dismantle/exec/executor.h"

namespace dismantle {

/// The triangles to bound.
struct BvhRefitInput {
  Span<const Vec3> vertices_t0;  ///< Positions at the start of the step, S_v(n) [mm].
  Span<const Vec3> vertices_t1;  ///< Positions at its end, S_v(n+1) [mm]; the same span if nothing moves.
  Span<const Face> faces;        ///< Vertex indices of each leaf's triangle, in leaf order.
  double margin = 0;             ///< By how much leaves are grown on every side [mm, >= 0].
  Span<const float> margins{};   ///< By how much each leaf is grown in addition, shape [leaf_count]; empty for none.
};

/// The cut of a hierarchy into blocks for CPU threads.
struct BvhRefitPlan {
  /// A subtree of one component whose bounds fit a core's cache.
  struct Block {
    NodeIndex leaf_begin;     ///< First leaf.
    NodeIndex leaf_end;       ///< One past the last leaf.
    NodeIndex inner_begin;    ///< First inner node.
    NodeIndex inner_end;      ///< One past the last inner node.
    std::uint32_t component;  ///< Its index.
  };
  std::vector<Block> blocks;  ///< Component after component.
  /// Inner nodes above the blocks, children before parents: component after component, then the top nodes.
  std::vector<NodeIndex> rest;
  std::vector<std::uint32_t> block_begin;  ///< Shape [component_count + 1]: a component's blocks.
  std::vector<std::uint32_t> rest_begin;   ///< Shape [component_count + 1]: a component's rest; top nodes follow.
};

/// Cuts a hierarchy into blocks.
BvhRefitPlan bvh_refit_plan(const Bvh& bvh);

/// Refits the subtrees of `components` and all nodes above them. Guarantee: bounds contain every vertex path exactly;
/// a parent contains its children bit for bit.
/// @param bounds of all nodes, shape [node_count]; those of other components must have been fitted before
void bvh_refit(const Bvh& bvh, const BvhRefitPlan& plan, const BvhRefitInput& input, Span<const ComponentId> components,
               Span<Kdop16> bounds, const Executor& executor);

/// Fits all nodes. @return their bounds, shape [node_count]
std::vector<Kdop16> bvh_fit(const Bvh& bvh, const BvhRefitPlan& plan, const BvhRefitInput& input,
                            const Executor& executor);

}  // namespace dismantle
