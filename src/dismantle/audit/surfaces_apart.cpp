// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/interval_tree.h"
#include "dismantle/audit/pair_motion.h"
#include "dismantle/audit/triangle_axes.h"

#include <utility>

namespace dismantle::audit {

bool surfaces_apart(const AuditBody& a, const AuditBody& b, const RigidTransform& a_from_b, double margin) {
  if (a.empty() || b.empty()) return true;
  const Interval time = interval_of({a_from_b, Screw{}});
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const BoxNode& node_a = a.node(i);
    const BoxNode& node_b = b.node(j);
    if (BoxInInterval(time, node_b, true).is_clear_of(node_a, margin)) continue;
    if (node_a.leaf() && node_b.leaf()) {
      const Triangle other = transformed(a_from_b, b.triangle(node_b.face));
      if (widest_gap(a.triangle(node_a.face), other, margin).gap <= margin) return false;
    } else if (node_b.leaf() || (!node_a.leaf() && node_a.radius >= node_b.radius)) {
      stack.push_back({i + 1, j});
      stack.push_back({node_a.right, j});
    } else {
      stack.push_back({i, j + 1});
      stack.push_back({i, node_b.right});
    }
  }
  return true;
}

}  // namespace dismantle::audit
