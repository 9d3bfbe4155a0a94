// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/front_parts.h"

#include "dismantle/bvh/bvh_traverse.h"

#include <algorithm>

namespace dismantle {

namespace {

constexpr std::size_t kNodesPerPartAtStart = 64;  // makes a front that starts from the root worth sharing

bool same_component(const BvhView& tree, NodePair p) {
  return !tree.is_top(p.a) && !tree.is_top(p.b) && tree.component_of[p.a] == tree.component_of[p.b];
}

bool two_leaves(const BvhView& tree, NodePair p) {
  return tree.is_leaf(p.a) && tree.is_leaf(p.b);
}

bool rests(const FrontInput& input, NodePair p) {
  if (input.motion_class.empty() || input.tree.is_top(p.a) || input.tree.is_top(p.b)) return false;
  return input.motion_class[input.tree.component_of[p.a]] == input.motion_class[input.tree.component_of[p.b]];
}

}  // namespace

void FrontParts::update(const FrontInput& input, const Executor& executor) {
  triangle_pairs_.clear();
  if (input.tree.leaf_count == 0) return;
  const bool starts = nodes_.empty() || excess_ > kFrontRestartShare * fresh_size_;
  if (starts) start(input);

  executor.for_each_heavy(parts_.size(), [&](std::size_t p) {
    Part part = std::move(parts_[p]);  // on the core's own stack: adjacent lists share cache lines
    part.nodes.clear();
    part.triangle_pairs.clear();
    for (std::size_t i = nodes_.size() * p / parts_.size(); i < nodes_.size() * (p + 1) / parts_.size(); ++i)
      sprout(nodes_[i], input, part);
    parts_[p] = std::move(part);
  });
  join(executor);
  if (starts) {
    fresh_size_ = nodes_.size();
    excess_ = 0;
  }
  excess_ += nodes_.size() - std::min(nodes_.size(), fresh_size_);
}

void FrontParts::sprout(std::uint64_t key, const FrontInput& input, Part& part) const {
  part.open.push_back(pair_of_key(key));
  while (!part.open.empty()) {
    const NodePair node = part.open.back();
    part.open.pop_back();
    if (same_component(input.tree, node)) continue;
    const bool ends = rests(input, node) || !overlaps(input.bounds[node.a], input.bounds[node.b]);
    if (ends || two_leaves(input.tree, node)) {
      part.nodes.push_back(pair_key(node.a, node.b));
      if (!ends) part.triangle_pairs.push_back(pair_key(node.a, node.b));
      continue;
    }
    const NodePairChildren next = expanded(input.tree, input.bounds, node);
    for (int k = 0; k < next.count; ++k) part.open.push_back(next.pair[k]);
  }
}

void FrontParts::start(const FrontInput& input) {
  const auto root = static_cast<NodeIndex>(input.bounds.size() - 1);
  nodes_ = {pair_key(root, root)};
  for (std::size_t i = 0; i < nodes_.size() && nodes_.size() < kNodesPerPartAtStart * parts_.size(); ++i) {
    const NodePair node = pair_of_key(nodes_[i]);
    if (two_leaves(input.tree, node) || same_component(input.tree, node)) continue;
    const NodePairChildren next = expanded(input.tree, input.bounds, node);
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
