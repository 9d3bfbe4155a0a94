// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/bvh_refit.h"

#include <utility>

namespace dismantle {

namespace {

constexpr NodeIndex kLeavesPerBlock = 1024;  // with their bounds 128 KiB: fits a core's second-level cache

/// Cuts the subtree below `node` (leaves from `leaf_begin` on, inner nodes from `inner_begin` on) into blocks.
struct PlanMaker {
  const Bvh& bvh;
  BvhRefitPlan& plan;
  std::uint32_t component;

  /// Cuts one subtree; in post-order its inner nodes come right before its root.
  void cut(NodeIndex leaf_begin, NodeIndex leaf_end, NodeIndex inner_begin) {
    const NodeIndex leaves = leaf_end - leaf_begin;
    if (leaves <= kLeavesPerBlock) {
      plan.blocks.push_back({leaf_begin, leaf_end, inner_begin, inner_begin + leaves - 1, component});
      return;
    }
    const NodeIndex node = inner_begin + leaves - 2;
    const NodeIndex left = bvh.children[node - bvh.leaf_count()].left;
    const NodeIndex left_leaves = left < bvh.leaf_count() ? 1 : left - inner_begin + 2;
    cut(leaf_begin, leaf_begin + left_leaves, inner_begin);
    cut(leaf_begin + left_leaves, leaf_end, inner_begin + left_leaves - 1);
    plan.rest.push_back(node);
  }
};

}  // namespace

BvhRefitPlan bvh_refit_plan(const Bvh& bvh) {
  BvhRefitPlan plan;
  for (std::uint32_t c = 0; c < bvh.components.size(); ++c) {
    plan.block_begin.push_back(static_cast<std::uint32_t>(plan.blocks.size()));
    plan.rest_begin.push_back(static_cast<std::uint32_t>(plan.rest.size()));
    const BvhComponent& range = bvh.components[c];
    if (range.leaf_count() > 0) PlanMaker{bvh, plan, c}.cut(range.leaf_begin, range.leaf_end, range.inner_begin);
  }
  plan.block_begin.push_back(static_cast<std::uint32_t>(plan.blocks.size()));
  plan.rest_begin.push_back(static_cast<std::uint32_t>(plan.rest.size()));
  if (!bvh.empty())
    for (NodeIndex node = bvh.top_begin; node < bvh.node_count(); ++node) plan.rest.push_back(node);
  return plan;
}

void bvh_refit(const Bvh& bvh, const BvhRefitPlan& plan, const BvhRefitInput& input, Span<const ComponentId> components,
               Span<Kdop16> bounds, const Executor& executor) {
  DISMANTLE_EXPECT(bounds.size() == bvh.node_count());
  DISMANTLE_EXPECT(input.margin >= 0);
  // Rounded up, as all bounds.
  const float margin = static_cast<float>(input.margin * (1 + 1e-6));
  const BvhRefitLeafKernel leaf_kernel{input.vertices_t0, input.vertices_t1, input.faces, bounds, margin,
                                       input.margins};
  const BvhRefitNodeKernel node_kernel{BvhView(bvh), bounds};
  const NodeIndex leaf_count = bvh.leaf_count();

  std::vector<std::uint32_t> blocks;
  for (const ComponentId c : components)
    for (std::uint32_t b = plan.block_begin[c.value]; b < plan.block_begin[c.value + 1]; ++b) blocks.push_back(b);
  executor.for_each_heavy(blocks.size(), [&](std::size_t i) {
    const BvhRefitPlan::Block& block = plan.blocks[blocks[i]];
    for (NodeIndex leaf = block.leaf_begin; leaf < block.leaf_end; ++leaf) leaf_kernel(leaf);
    for (NodeIndex node = block.inner_begin; node < block.inner_end; ++node) node_kernel(node - leaf_count);
  });

  for (const ComponentId c : components)
    for (std::uint32_t r = plan.rest_begin[c.value]; r < plan.rest_begin[c.value + 1]; ++r)
      node_kernel(plan.rest[r] - leaf_count);
  for (std::size_t r = plan.rest_begin.back(); r < plan.rest.size(); ++r) node_kernel(plan.rest[r] - leaf_count);
}

std::vector<Kdop16> bvh_fit(const Bvh& bvh, const BvhRefitPlan& plan, const BvhRefitInput& input,
                            const Executor& executor) {
  std::vector<Kdop16> bounds(bvh.node_count());
  std::vector<ComponentId> all;
  for (std::uint32_t c = 0; c < bvh.components.size(); ++c) all.push_back(ComponentId(c));
  bvh_refit(bvh, plan, input, all, bounds, executor);
  return bounds;
}

}  // namespace dismantle
