// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/pair_state.h"

#include <algorithm>
#include <utility>

namespace dismantle {

std::string_view name_of(PairState state) {
  switch (state) {
    case PairState::Clear:
      return "clear";
    case PairState::Near:
      return "near";
    case PairState::Contact:
      return "contact";
    case PairState::Overlapping:
      return "overlapping";
    case PairState::Free:
      return "free";
  }
  return "";
}

const ComponentPair* PairStates::find(ComponentId a, ComponentId b) const {
  if (b < a) std::swap(a, b);
  const auto found = std::lower_bound(
      pairs.begin(), pairs.end(), std::pair(a, b),
      [](const ComponentPair& p, const auto& key) { return p.a != key.first ? p.a < key.first : p.b < key.second; });
  return found != pairs.end() && found->a == a && found->b == b ? &*found : nullptr;
}

void PairStates::raise_allowances(const std::vector<ComponentPair>& with) {
  for (const ComponentPair& pair : with)
    if (const ComponentPair* known = find(pair.a, pair.b)) {
      ComponentPair& own = pairs[static_cast<std::size_t>(known - pairs.data())];
      own.allowed_depth = std::max(own.allowed_depth, pair.allowed_depth);
    }
}

bool PairStates::declare(ComponentId a, ComponentId b, double depth) {
  ComponentPair& pair = pairs[static_cast<std::size_t>(find(a, b) - pairs.data())];
  if (pair.allowed_depth >= depth) return false;
  pair.declared = pair.allowed_depth = depth;
  return true;
}

}  // namespace dismantle
