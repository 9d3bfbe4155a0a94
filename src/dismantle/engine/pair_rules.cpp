// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/pair_rules.h"

#include <bit>

namespace dismantle {

namespace {

PairRule rule_of(const ComponentPair& pair) {
  switch (pair.state) {
    case PairState::Clear:
    case PairState::Near:
      return {PairTest::Ordinary, pair.allowed_depth};
    case PairState::Contact:
      return {PairTest::Certified, pair.allowed_depth};
    case PairState::Overlapping:
    case PairState::Free:
      return {PairTest::Discrete, 0};
  }
  return {};
}

}  // namespace

PairRules::PairRules(const PairStates& states)
    : table_(std::bit_ceil(2 * states.pairs.size() + 2)), tolerance_(states.tolerance) {
  for (const ComponentPair& pair : states.pairs) {
    DISMANTLE_EXPECT(pair.a < pair.b);
    std::size_t i = PairRulesView::hash(pair.a.value, pair.b.value) & (table_.size() - 1);
    while (table_[i].a != PairRuleEntry::kFree) i = (i + 1) & (table_.size() - 1);
    table_[i] = {pair.a.value, pair.b.value, rule_of(pair)};
  }
}

void PairRules::part(ComponentId a, ComponentId b) {
  for (PairRuleEntry& entry : table_) {
    if (entry.a != a.value || entry.b != b.value) continue;
    DISMANTLE_EXPECT(entry.rule.test == PairTest::Discrete);
    entry.rule = {PairTest::Certified, tolerance_};
  }
}

}  // namespace dismantle
