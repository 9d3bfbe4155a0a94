// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/pair_rules.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace dismantle {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

ComponentPair pair(std::uint32_t a, std::uint32_t b, PairState state, double allowed) {
  ComponentPair p;
  p.a = ComponentId(a);
  p.b = ComponentId(b);
  p.state = state;
  p.allowed_depth = allowed;
  return p;
}

TEST(PairRules, GiveEveryStateItsTest) {
  PairStates states;
  states.tolerance = 0.01;
  states.pairs = {pair(0, 1, PairState::Near, 0.01), pair(0, 2, PairState::Contact, 0.01),
                  pair(1, 5, PairState::Overlapping, 2), pair(2, 5, PairState::Free, kUnlimited)};
  const PairRules rules(states);
  EXPECT_EQ(rules.view().find(0, 1).test, PairTest::Ordinary);
  EXPECT_EQ(rules.view().find(0, 2).test, PairTest::Certified);
  EXPECT_EQ(rules.view().find(1, 5).test, PairTest::Certified);
  EXPECT_EQ(rules.view().find(2, 5).test, PairTest::Discrete);
  EXPECT_EQ(rules.view().find(3, 4), PairRule{});
}

TEST(PairRules, FindEveryPairOfManyAndNoOther) {
  std::mt19937_64 random(3);
  std::set<std::pair<std::uint32_t, std::uint32_t>> listed;
  while (listed.size() < 3000) {
    const auto a = static_cast<std::uint32_t>(random() % 500), b = static_cast<std::uint32_t>(random() % 500);
    if (a < b) listed.emplace(a, b);
  }
  PairStates states;
  states.tolerance = 1;
  for (const auto& [a, b] : listed) states.pairs.push_back(pair(a, b, PairState::Contact, 1));
  PairRules rules(states);
  for (const auto& [a, b] : listed) rules.set(ComponentId(a), ComponentId(b), {PairTest::None, 2 + a, 3 + b});
  for (std::uint32_t a = 0; a < 500; ++a) {
    for (std::uint32_t b = a + 1; b < 500; ++b) {
      const PairRule expected = listed.count({a, b}) > 0 ? PairRule{PairTest::None, 2 + a, 3 + b} : PairRule{};
      ASSERT_EQ(rules.view().find(a, b), expected);
    }
  }
}

TEST(PairRules, FindNoOtherPairHoweverFewAreListed) {
  for (std::uint32_t count = 0; count <= 40; ++count) {
    PairStates states;
    states.tolerance = 1;
    for (std::uint32_t k = 0; k < count; ++k) states.pairs.push_back(pair(k, k + 1, PairState::Contact, 1));
    const PairRules rules(states);
    for (std::uint32_t a = 0; a < 60; ++a)
      for (std::uint32_t b = a + 1; b < 60; ++b)
        ASSERT_EQ(rules.view().find(a, b).test, b == a + 1 && a < count ? PairTest::Certified : PairTest::Ordinary)
            << count << " pairs";
  }
}

}  // namespace
}  // namespace dismantle
