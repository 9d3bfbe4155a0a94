// SPDX-License-Identifier: Apache-2.0
#include "bench/timing.h"

#include <gtest/gtest.h>

namespace dismantle::bench {
namespace {

TEST(Quantile, IsTheValueOfTheNearestRank) {
  const std::vector<double> values{5, 1, 4, 2, 3};
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile(values, 0.2), 1);
  EXPECT_EQ(quantile(values, 0.5), 3);
  EXPECT_EQ(quantile(values, 0.99), 5);
  EXPECT_EQ(quantile(values, 1), 5);
  EXPECT_EQ(quantile(std::vector<float>{}, 0.5), 0);
  std::vector<double> many;
  for (int i = 1; i <= 200; ++i) many.push_back(i);
  EXPECT_EQ(quantile(many, 0.5), 100);
  EXPECT_EQ(quantile(many, 0.99), 198);
}

TEST(Mean, IsZeroOfNoValues) {
  EXPECT_EQ(mean({}), 0);
  EXPECT_EQ(mean({1, 2, 6}), 3);
}

double& fake_time() {
  static double ns = 0;
  return ns;
}

TEST(FastestNs, LeavesOutTheWarmUpAndTakesTheShortestPass) {
  const double durations[] = {1, 9, 4, 7};
  int pass = 0;
  const double ns = fastest_ns(
      3, [&] { fake_time() += durations[pass++]; }, [] { return fake_time(); });
  EXPECT_EQ(pass, 4);
  EXPECT_EQ(ns, 4);
}

TEST(Stopwatch, CountsFromItsConstructionInEveryUnit) {
  const Stopwatch watch([] { return fake_time(); });
  fake_time() += 2e9;
  EXPECT_EQ(watch.ns(), 2e9);
  EXPECT_EQ(watch.us(), 2e6);
  EXPECT_EQ(watch.ms(), 2e3);
  EXPECT_EQ(watch.seconds(), 2);
}

}  // namespace
}  // namespace dismantle::bench
