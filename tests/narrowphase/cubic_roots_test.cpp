// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/cubic_roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle {
namespace {

/// lead * (t - r0)(t - r1)(t - r2) in Bernstein form.
BernsteinCubic cubic_of_roots(double lead, double r0, double r1, double r2) {
  const double sum = r0 + r1 + r2, pairs = r0 * r1 + r1 * r2 + r2 * r0, product = r0 * r1 * r2;
  const double power[4] = {-lead * product, lead * pairs, -lead * sum, lead};
  BernsteinCubic cubic;
  cubic.c[0] = power[0];
  cubic.c[1] = power[0] + power[1] / 3;
  cubic.c[2] = power[0] + 2 * power[1] / 3 + power[2] / 3;
  cubic.c[3] = power[0] + power[1] + power[2] + power[3];
  return cubic;
}

double nearest(const CubicRoots& roots, double t) {
  double minimum = 1e9;
  for (int i = 0; i < roots.count; ++i) minimum = std::min(minimum, std::abs(roots.time[i] - t));
  return minimum;
}

TEST(CubicRoots, FindsThreeSimpleRootsInOrder) {
  const CubicRoots roots = cubic_roots(cubic_of_roots(3, 0.75, 0.25, 0.5));
  ASSERT_EQ(roots.count, 3);
  EXPECT_NEAR(roots.time[0], 0.25, 1e-14);
  EXPECT_NEAR(roots.time[1], 0.5, 1e-14);
  EXPECT_NEAR(roots.time[2], 0.75, 1e-14);
}

TEST(CubicRoots, FindsRootsAtBothEnds) {
  const CubicRoots roots = cubic_roots(cubic_of_roots(-3, 0, 1, 4));
  EXPECT_EQ(nearest(roots, 0), 0);
  EXPECT_EQ(nearest(roots, 1), 0);
}

TEST(CubicRoots, FindsNoneIfTheCubicKeepsItsSign) {
  EXPECT_EQ(cubic_roots(cubic_of_roots(3, -1, -2, -0.5)).count, 0);
  EXPECT_EQ(cubic_roots(cubic_of_roots(3, 2, 5, 1.25)).count, 0);
}

TEST(CubicRoots, FindsTheRootOfALineAndOfAParabola) {
  const CubicRoots line = cubic_roots({{-1, 0, 1, 2}, 0});
  ASSERT_EQ(line.count, 1);
  EXPECT_NEAR(line.time[0], 1.0 / 3, 1e-15);
  // 9 (t - 1/4)(t - 3/4) = 9 t^2 - 9 t + 27/16
  const double c = 27.0 / 16;
  const CubicRoots parabola = cubic_roots({{c, c - 3, c - 3, c}, 0});
  EXPECT_LT(nearest(parabola, 0.25), 1e-14);
  EXPECT_LT(nearest(parabola, 0.75), 1e-14);
}

TEST(CubicRoots, CallsTheZeroCubicAlwaysCoplanar) {
  EXPECT_TRUE(always_coplanar(BernsteinCubic{}));
  EXPECT_TRUE(always_coplanar({{1e-20, -1e-20, 0, 1e-20}, 1e-19}));
  EXPECT_FALSE(always_coplanar({{1e-20, -1e-20, 0, 1e-18}, 1e-19}));
}

TEST(CubicRoots, MissesNoRootOfRandomCubicsNearDoubleAndTripleOnesIncluded) {
  constexpr unsigned kSeed = 20150715;
  RecordProperty("seed", kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(0, 1), exponent(-16, 0), scale(-12, 12);
  int checked = 0;
  for (int i = 0; i < 200000; ++i) {
    // A root in [0, 1], another at a log-uniform distance from it, and a third anywhere or also close.
    const double r0 = unit(random);
    const double r1 = r0 + (unit(random) < 0.5 ? -1 : 1) * std::pow(10, exponent(random));
    const double r2 = unit(random) < 0.3 ? r0 + std::pow(10, exponent(random)) : 6 * unit(random) - 3;
    const CubicRoots roots = cubic_roots(cubic_of_roots(std::pow(10, scale(random)), r0, r1, r2));
    // Rounding the coefficients moves a simple root by about u / |gaps|, a double by sqrt(u), a triple by cbrt(u).
    for (const double r : {r0, r1, r2}) {
      if (!(r >= 1e-5 && r <= 1 - 1e-5)) continue;
      ++checked;
      const double gap = std::min({std::abs(r0 - r1), std::abs(r1 - r2), std::abs(r2 - r0)});
      const double reach = gap > 1e-3 ? 1e-8 : 2e-5;
      ASSERT_LT(nearest(roots, r), reach) << "seed " << kSeed << " cubic " << i << ": " << r0 << " " << r1 << " " << r2;
    }
  }
  EXPECT_GT(checked, 300000);
}

TEST(CubicRoots, ListsTheRootsAscending) {
  constexpr unsigned kSeed = 7;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int i = 0; i < 100000; ++i) {
    const BernsteinCubic cubic{{value(random), value(random), value(random), value(random)}, 0};
    const CubicRoots roots = cubic_roots(cubic);
    ASSERT_TRUE(std::is_sorted(roots.time, roots.time + roots.count)) << "seed " << kSeed << " cubic " << i;
    ASSERT_TRUE(cubic.c[0] * cubic.c[3] > 0 || roots.count >= 1) << "seed " << kSeed << " cubic " << i;
    for (int k = 0; k < roots.count; ++k) ASSERT_NEAR(value_at(cubic, roots.time[k]), 0, 1e-14);
  }
}

}  // namespace
}  // namespace dismantle
