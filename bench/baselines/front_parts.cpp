// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/front_parts.h"

#include "dismantle/bvh/bvh_traverse.h"
#include "dismantle/front/front.h"

#include <algorithm>

namespace dismantle {

namespace {

constexpr std::size_t kNodesPerPartAtStart = 64;  // so that a front that starts from the root is worth sharing

bool same_component(const BvhView& tree, NodePair p) {
  return !tree.is_top(p.a) && !tree.is_top(p.b) && tree.component_of[p.a] == tree.component_of[p.b];
}

bool two_leaves(const BvhView& tree, NodePair p) {
  return tree.is_leaf(p.a) && tree.is_leaf(p.b);
}

}  // namespace

void FrontParts::update(const BvhView& tree, Span<const Kdop16> bounds, const Executor& executor) {
  triangle_pairs_.clear();
  if (tree.leaf_count == 0) return;
  const bool starts = nodes_.empty() || excess_ > kFrontRestartShare * fresh_size_;
  if (starts) start(tree, bounds);

  executor.for_each_heavy(parts_.size(), [&](std::size_t p) {
    Part& part = parts_[p];
    part.nodes.clear();
    part.triangle_pairs.clear();
    std::vector<NodePair> open;
    for (std::size_t i = nodes_.size() * p / parts_.size(); i < nodes_.size() * (p + 1) / parts_.size(); ++i) {
      open.push_back(pair_of_key(nodes_[i]));
      while (!open.empty()) {
        const NodePair node = open.back();
        open.pop_back();
        if (same_component(tree, node)) continue;
        const bool apart = !overlaps(bounds[node.a], bounds[node.b]);
        if (apart || two_leaves(tree, node)) {
          part.nodes.push_back(pair_key(node.a, node.b));
          if (!apart) part.triangle_pairs.push_back(pair_key(node.a, node.b));
          continue;
        }
        const NodePairChildren next = expanded(tree, bounds, node);
        for (int k = 0; k < next.count; ++k) open.push_back(next.pair[k]);
      }
    }
  });
  join(executor);
  if (starts) {
    fresh_size_ = nodes_.size();
    excess_ = 0;
  }
  excess_ += nodes_.size() - std::min(nodes_.size(), fresh_size_);
}

void FrontParts::start(const BvhView& tree, Span<const Kdop16> bounds) {
  const auto root = static_cast<NodeIndex>(bounds.size() - 1);
  nodes_ = {pair_key(root, root)};
  for (std::size_t i = 0; i < nodes_.size() && nodes_.size() < kNodesPerPartAtStart * parts_.size(); ++i) {
    const NodePair node = pair_of_key(nodes_[i]);
    if (two_leaves(tree, node) || same_component(tree, node)) continue;
    const NodePairChildren next = expanded(tree, bounds, node);
    nodes_[i] = pair_key(next.pair[0].a, next.pair[0].b);
    for (int k = 1; k < next.count; ++k) nodes_.push_back(pair_key(next.pair[k].a, next.pair[k].b));
  }
}

void FrontParts::join(const Executor& executor) {
  std::vector<std::size_t> node_begin{0}, pair_begin{0};
  for (const Part& part : parts_) {
    node_begin.push_back(node_begin.back() + part.nodes.size());
    pair_begin.push_back(pair_begin.back() + part.triangle_pairs.size());
  }
  nodes_.resize(node_begin.back());
  triangle_pairs_.resize(pair_begin.back());
  executor.for_each_heavy(parts_.size(), [&](std::size_t p) {
    std::copy(parts_[p].nodes.begin(), parts_[p].nodes.end(), &nodes_[0] + node_begin[p]);
    std::copy(parts_[p].triangle_pairs.begin(), parts_[p].triangle_pairs.end(), &triangle_pairs_[0] + pair_begin[p]);
  });
}

}  // namespace dismantle
