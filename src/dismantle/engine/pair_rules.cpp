// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/pair_rules.h"

#include <bit>

namespace dismantle {

namespace {

PairTest test_of(PairState state) {
  switch (state) {
    case PairState::Clear:
    case PairState::Near:
      return PairTest::Ordinary;
    case PairState::Contact:
    case PairState::Overlapping:
      return PairTest::Certified;
    case PairState::Free:
      return PairTest::Discrete;
  }
  return {};
}

}  // namespace

PairRules::PairRules(const PairStates& states) : table_(std::bit_ceil(2 * states.pairs.size() + 2)) {
  for (const ComponentPair& pair : states.pairs) {
    DISMANTLE_EXPECT(pair.a < pair.b);
    slot(pair.a, pair.b) = {pair.a.value, pair.b.value, {test_of(pair.state)}};
  }
}

void PairRules::set(ComponentId a, ComponentId b, const PairRule& rule) {
  PairRuleEntry& entry = slot(a, b);
  DISMANTLE_EXPECT(entry.a != PairRuleEntry::kFree);
  entry.rule = rule;
}

/// The slot of a pair, or the empty one in which it belongs.
PairRuleEntry& PairRules::slot(ComponentId a, ComponentId b) {
  std::size_t i = PairRulesView::hash(a.value, b.value);
  const auto at = [&](std::size_t k) -> PairRuleEntry& { return table_[k & (table_.size() - 1)]; };
  while (at(i).a != PairRuleEntry::kFree && (at(i).a != a.value || at(i).b != b.value)) ++i;
  return at(i);
}

}  // namespace dismantle
