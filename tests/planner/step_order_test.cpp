// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/order/step_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace dismantle {
namespace {

using Order = std::vector<std::uint32_t>;
using Steps = std::vector<OrderedStep>;

const KeepGoing kAlways = [] { return true; };
constexpr OrderWeights kNothing{0, 0, 0, 0, 0, 0};

Order as_given(const Steps& steps) {
  Order order(steps.size());
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

bool complies(const Steps& steps, const Order& order) {
  Order place(order.size(), 0xffffffffu);
  for (std::uint32_t i = 0; i < order.size(); ++i) place.at(order[i]) = i;
  for (std::uint32_t k = 0; k < steps.size(); ++k)
    for (const std::uint32_t j : steps[k].before)
      if (place[j] > place[k]) return false;
  return std::find(place.begin(), place.end(), 0xffffffffu) == place.end();
}

double best_cost(const Steps& steps, const OrderWeights& weights) {
  const Order order = best_order(steps, weights, kAlways);
  EXPECT_TRUE(complies(steps, order));
  return order_cost(steps, weights, order);
}

/// The lowest cost of all orders that comply, written down from what the weights say and not from the search.
double lowest_cost(const Steps& steps, const OrderWeights& weights) {
  double lowest = std::numeric_limits<double>::infinity();
  Order order = as_given(steps);
  do {
    if (!complies(steps, order)) continue;
    Order place(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    double cost = weights.groups;
    int up = 1;
    std::uint32_t tool = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const OrderedStep& step = steps[order[i]];
      if (i > 0 && step.kind != steps[order[i - 1]].kind) cost += weights.groups;
      if (i > 0 && step.direction != steps[order[i - 1]].direction) cost += weights.direction;
      if (step.up == -up) {
        cost += weights.upright;
        up = step.up;
      }
      if (step.tool != 0) {
        if (tool != 0 && tool != step.tool) cost += weights.tools;
        tool = step.tool;
      }
    }
    const auto last_of = [&](const Order& others) {
      std::uint32_t last = 0;
      for (const std::uint32_t other : others) last = std::max(last, place[other]);
      return last;
    };
    for (std::uint32_t k = 0; k < steps.size(); ++k) {
      if (!steps[k].held_by.empty() && last_of(steps[k].held_by) < place[k])
        cost += weights.loose * (place[k] - last_of(steps[k].held_by));
      if (!steps[k].rests_on.empty() && last_of(steps[k].rests_on) < place[k]) cost += weights.support;
    }
    lowest = std::min(lowest, cost);
  } while (std::next_permutation(order.begin(), order.end()));
  return lowest;
}

Steps random_steps(std::mt19937& random, std::uint32_t count) {
  const auto one_of = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  Steps steps(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    steps[k].kind = one_of(6);
    steps[k].direction = steps[k].kind % 4;
    steps[k].up = static_cast<int>(steps[k].kind % 3) - 1;
    steps[k].tool = steps[k].kind % 2 + steps[k].kind % 3;
    for (std::uint32_t j = 0; j < k; ++j) {
      if (one_of(5) == 0) steps[k].before.push_back(j);
      if (one_of(8) == 0) steps[k].rests_on.push_back(j);
    }
    for (const std::uint32_t j : steps[k].before)
      if (one_of(2) == 0) steps[k].held_by.push_back(j);
  }
  return steps;
}

TEST(StepOrder, IsTheBestOfAllOrdersOfAFewSteps) {
  std::mt19937 random(4);
  for (int k = 0; k < 300; ++k) {
    const Steps steps = random_steps(random, 3 + k % 5);
    for (const OrderWeights& weights :
         {OrderWeights{}, OrderWeights{0, 0, 0, 0, 1, 0}, OrderWeights{1, 3, 0.3, 2, 0.1, 0.7}}) {
      EXPECT_NEAR(best_cost(steps, weights), lowest_cost(steps, weights), 1e-9) << k;
    }
  }
}

/// Columns of parts of the same kinds, one on another, in the order column by column.
Steps columns(std::uint32_t count, std::uint32_t layers) {
  Steps steps;
  for (std::uint32_t column = 0; column < count; ++column)
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
      OrderedStep step;
      step.kind = layer;
      if (layer > 0) step.before = {static_cast<std::uint32_t>(steps.size() - 1)};
      steps.push_back(step);
    }
  return steps;
}

TEST(StepOrder, TakesEqualPartsOfColumnsTogether) {
  OrderWeights weights = kNothing;
  weights.groups = 1;
  const Steps steps = columns(30, 6);
  EXPECT_EQ(order_cost(steps, weights, as_given(steps)), 180);
  EXPECT_EQ(best_cost(steps, weights), 6);
}

TEST(StepOrder, TakesMixedColumnsWithFewChangesOfKind) {
  // Kinds 0, 1, 2, 3 and 0, 2, 1, 3: one of the kinds in the middle has to come in two runs.
  Steps steps = columns(20, 4);
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (k % 8 > 4 && k % 8 < 7) steps[k].kind = 3 - steps[k].kind;
  OrderWeights weights = kNothing;
  weights.groups = 1;
  EXPECT_EQ(best_cost(steps, weights), 5);
}

TEST(StepOrder, ChangesTheDirectionOnceForEachFurtherOne) {
  // Layers on five faces of a block; corner pieces leave along the direction of one face, after those of its neighbour.
  Steps steps;
  for (std::uint32_t piece = 0; piece < 100; ++piece) {
    OrderedStep step;
    step.kind = piece;
    step.direction = piece * 7 % 5;
    for (std::uint32_t j = 0; j < piece; ++j)
      if (steps[j].direction <= step.direction && (piece + 3 * j) % 11 == 0) step.before.push_back(j);
    steps.push_back(step);
  }
  OrderWeights weights = kNothing;
  weights.direction = 1;
  EXPECT_GT(order_cost(steps, weights, as_given(steps)), 90);
  EXPECT_EQ(best_cost(steps, weights), 4);
}

TEST(StepOrder, TurnsTheProductOverOnce) {
  Steps steps(60);
  for (std::uint32_t k = 0; k < steps.size(); ++k) {
    steps[k].kind = k;
    steps[k].up = k % 3 == 0 ? -1 : k % 3 == 1 ? 1 : 0;
    if (k >= 9 && k % 2 == 1) steps[k].before = {k - 9};  // of the same side
  }
  OrderWeights weights = kNothing;
  weights.upright = 1;
  EXPECT_EQ(best_cost(steps, weights), 1);
}

TEST(StepOrder, KeepsTheToolInHand) {
  Steps steps(80);
  for (std::uint32_t k = 0; k < steps.size(); ++k) {
    steps[k].kind = k;
    steps[k].tool = k % 5;  // none with 0
    if (k >= 5) steps[k].before = {k - 5};
  }
  OrderWeights weights = kNothing;
  weights.tools = 1;
  EXPECT_EQ(best_cost(steps, weights), 3);
}

TEST(StepOrder, KeepsTogetherWhatFollowsAtOnce) {
  Steps steps;  // nuts and bolts, and plates of two kinds in between
  for (std::uint32_t k = 0; k < 30; ++k) {
    OrderedStep& step = steps.emplace_back();
    step.kind = k % 3 == 2 ? 1 + k % 2 : 0;
    step.direction = k % 3 == 0 ? 1 : 0;
    if (k % 3 == 0) step.followed_by = k + 1;
    if (k % 3 == 1) step.before = {k - 1};
  }
  OrderWeights weights = kNothing;
  weights.groups = 1;
  weights.direction = 1e-3;
  const Order order = best_order(steps, weights, kAlways);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_TRUE(order[i] % 3 != 0 || order.at(i + 1) == order[i] + 1);
  EXPECT_NEAR(order_cost(steps, weights, order), 3, 0.1);
}

TEST(StepOrder, TakesAwayWhatItsLastScrewHeld) {
  Steps steps;  // 15 lids with four screws each: all screws, then all lids
  for (std::uint32_t k = 0; k < 60; ++k) steps.emplace_back().kind = 1;
  for (std::uint32_t lid = 0; lid < 15; ++lid) {
    OrderedStep& step = steps.emplace_back();
    step.kind = 2;
    for (std::uint32_t k = 0; k < 4; ++k) step.before.push_back(4 * lid + k);
    step.held_by = step.before;
  }
  OrderWeights weights = kNothing;
  weights.loose = 1;
  EXPECT_GT(order_cost(steps, weights, as_given(steps)), 100);
  EXPECT_EQ(best_cost(steps, weights), 15) << "each lid during the step that removes it";
  weights.groups = 300;
  const Order order = best_order(steps, weights, kAlways);
  EXPECT_TRUE(std::all_of(order.begin(), order.begin() + 60, [](std::uint32_t k) { return k < 60; }))
      << "equal screws together are worth more";
}

TEST(StepOrder, LeavesNothingWithoutSupport) {
  Steps steps(40);  // each of the second half lies on one of the first
  for (std::uint32_t k = 0; k < 40; ++k) {
    steps[k].kind = k;
    if (k >= 20) steps[k].rests_on = {k - 20};
  }
  OrderWeights weights = kNothing;
  weights.support = 1;
  EXPECT_EQ(order_cost(steps, weights, as_given(steps)), 20);
  EXPECT_EQ(best_cost(steps, weights), 0);
}

TEST(StepOrder, StaysAsItIsUnlessAnotherOneIsBetter) {
  std::mt19937 random(7);
  for (int k = 0; k < 20; ++k) {
    const Steps steps = random_steps(random, 30);
    EXPECT_EQ(best_order(steps, kNothing, kAlways), as_given(steps));
    const Order order = best_order(steps, {}, kAlways);
    EXPECT_LE(order_cost(steps, {}, order), order_cost(steps, {}, as_given(steps)));
  }
  const Steps layers = columns(1, 50);
  EXPECT_EQ(best_order(layers, {}, kAlways), as_given(layers));
}

TEST(StepOrder, EndsWhenItIsTold) {
  const Steps steps = columns(30, 6);
  int calls = 0;
  EXPECT_EQ(best_order(steps, {}, [&] { return ++calls < 100; }), as_given(steps));
  EXPECT_EQ(calls, 100);
}

TEST(StepOrder, IsFoundForThousandsOfSteps) {
  const Steps steps = columns(1000, 5);
  OrderWeights weights = kNothing;
  weights.groups = 1;
  EXPECT_EQ(best_cost(steps, weights), 5);
}

TEST(StepOrder, OfNoStepsIsEmpty) {
  EXPECT_TRUE(best_order({}, {}, kAlways).empty());
}

}  // namespace
}  // namespace dismantle
