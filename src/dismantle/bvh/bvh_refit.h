// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh_refit_kernel.h"
#include "dismantle/exec/executor.h"

namespace dismantle {

/// What bounds are made of.
struct BvhRefitInput {
  Span<const Vec3> vertices_t0, vertices_t1;  ///< S_v(n), S_v(n+1) [mm]; the same span twice for a moment in time.
  Span<const Face> faces;                     ///< Vertex indices of each leaf's triangle: in leaf order.
  double margin = 0;                          ///< By how much leaves are grown on every side [mm, >= 0].
};

/// How a hierarchy is cut for CPU threads: each block is a subtree of one component that stays in a core's cache, its
/// leaves and inner nodes one range each; `rest` are the inner nodes above the blocks, children first.
struct BvhRefitPlan {
  struct Block {
    NodeIndex leaf_begin, leaf_end;
    NodeIndex inner_begin, inner_end;
    std::uint32_t component;
  };
  std::vector<Block> blocks;               ///< Component after component.
  std::vector<NodeIndex> rest;             ///< Of components, component after component; then the top nodes.
  std::vector<std::uint32_t> block_begin;  ///< Shape [component_count + 1]: a component's blocks.
  std::vector<std::uint32_t> rest_begin;   ///< Shape [component_count + 1]: a component's rest; top nodes follow.
};

BvhRefitPlan bvh_refit_plan(const Bvh& bvh);

/// Refits the subtrees of `components` and all nodes above them. Guarantee: bounds contain every vertex path exactly;
/// a parent contains its children bit for bit.
/// @param bounds of all nodes, shape [node_count]; those of other components must be fitted already
void bvh_refit(const Bvh& bvh, const BvhRefitPlan& plan, const BvhRefitInput& input, Span<const ComponentId> components,
               Span<Kdop16> bounds, const Executor& executor);

/// Fits all nodes.
std::vector<Kdop16> bvh_fit(const Bvh& bvh, const BvhRefitPlan& plan, const BvhRefitInput& input,
                            const Executor& executor);

}  // namespace dismantle
