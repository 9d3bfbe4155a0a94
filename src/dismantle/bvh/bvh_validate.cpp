// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/bvh_validate.h"

#include <algorithm>

namespace dismantle {

namespace {

std::string at(const char* problem, std::size_t index) {
  return std::string(problem) + " at " + std::to_string(index);
}

std::string check_leaves(const Bvh& bvh) {
  std::vector<bool> seen(bvh.leaf_count(), false);
  for (const std::uint32_t triangle : bvh.leaf_triangle) {
    if (triangle >= seen.size() || seen[triangle]) return at("triangle has no leaf of its own", triangle);
    seen[triangle] = true;
  }
  return {};
}

std::string check_links(const Bvh& bvh) {
  std::vector<int> parents(bvh.node_count(), 0);
  for (NodeIndex i = 0; i < bvh.children.size(); ++i) {
    const NodeIndex node = bvh.leaf_count() + i;
    const BvhChildren c = bvh.children[i];
    for (const NodeIndex child : {c.left, c.right}) {
      if (child >= node) return at("child does not come before its parent", node);
      ++parents[child];
      if (bvh.component_of[node] != ComponentId::kInvalid && bvh.component_of[child] != bvh.component_of[node])
        return at("subtree of a component has a node of another", node);
    }
    if ((bvh.component_of[node] == ComponentId::kInvalid) != (node >= bvh.top_begin))
      return at("top node among the components' nodes, or a component's node among the top nodes", node);
  }
  for (NodeIndex node = 0; node + 1 < bvh.node_count(); ++node)
    if (parents[node] != 1) return at("node has not exactly one parent", node);
  return {};
}

std::string check_components(const Bvh& bvh) {
  for (std::uint32_t c = 0; c < bvh.components.size(); ++c) {
    const BvhComponent& range = bvh.components[c];
    if (range.leaf_count() == 0) continue;
    for (NodeIndex i = range.leaf_begin; i < range.leaf_end; ++i) {
      if (bvh.component_of[i] != c) return at("leaf outside of its component's range", i);
      if (bvh.leaf_triangle[i] < range.leaf_begin || bvh.leaf_triangle[i] >= range.leaf_end)
        return at("leaf has a triangle of another component", i);
    }
    const NodeIndex last = range.leaf_count() == 1 ? range.leaf_begin : range.inner_end - 1;
    if (range.root != last) return at("component root is not its last node", c);
  }
  return {};
}

}  // namespace

std::string bvh_validate(const Bvh& bvh) {
  if (bvh.empty()) return bvh.children.empty() ? std::string() : "inner nodes without leaves";
  if (bvh.children.size() + 1 != bvh.leaf_count()) return "inner nodes are not one fewer than leaves";
  if (bvh.component_of.size() != bvh.node_count()) return "not every node has a component entry";
  std::string problem = check_leaves(bvh);
  if (problem.empty()) problem = check_links(bvh);
  if (problem.empty()) problem = check_components(bvh);
  return problem;
}

std::string bvh_validate(const Bvh& bvh, Span<const Kdop16> bounds) {
  std::string problem = bvh_validate(bvh);
  if (!problem.empty()) return problem;
  if (bounds.size() != bvh.node_count()) return "not every node has bounds";
  for (NodeIndex i = 0; i < bvh.children.size(); ++i) {
    const BvhChildren c = bvh.children[i];
    const Kdop16& parent = bounds[bvh.leaf_count() + i];
    if (!contains(parent, bounds[c.left]) || !contains(parent, bounds[c.right]))
      return at("parent does not contain its child", bvh.leaf_count() + i);
  }
  return {};
}

int bvh_depth(const Bvh& bvh) {
  // Children come before parents, so heights are known in ascending order.
  std::vector<int> height(bvh.node_count(), 0);
  for (NodeIndex i = 0; i < bvh.children.size(); ++i) {
    const BvhChildren c = bvh.children[i];
    height[bvh.leaf_count() + i] = 1 + std::max(height[c.left], height[c.right]);
  }
  return bvh.empty() ? 0 : height[bvh.root()];
}

}  // namespace dismantle
