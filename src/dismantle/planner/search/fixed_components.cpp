// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/fixed_components.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Relative difference below which components count as equally large (rounding in a rotated assembly).
constexpr double kSameSize = 1e-6;

}  // namespace

ComponentSet fixed_components(const ComponentSet& body, Span<const ComponentId> fixed,
                              const std::vector<ShapeFeatures>& features, const RigidGroups& groups) {
  ComponentSet staying(body.universe());
  for (const ComponentId c : fixed)
    if (body.has(c)) staying.insert(c);
  if (staying.size() > 0) return staying;
  const std::vector<ComponentId> members = body.members();
  double largest = 0;
  for (const ComponentId c : members) largest = std::max(largest, features[c.value].area);
  const auto largest_one = std::find_if(members.begin(), members.end(), [&](ComponentId c) {
    return features[c.value].area >= (1 - kSameSize) * largest;
  });
  for (const ComponentId c : groups.of(*largest_one)) staying.insert(c);
  return staying;
}

}  // namespace dismantle
