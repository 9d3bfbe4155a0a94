// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/triangle_axes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle::audit {
namespace {

constexpr double kAll = 1e300;

Vec3 random_vector(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

Triangle random_triangle(std::mt19937_64& random, double size) {
  return {{size * random_vector(random), size * random_vector(random), size * random_vector(random)}};
}

Triangle moved_by(const Triangle& t, Vec3 shift) {
  return {{t[0] + shift, t[1] + shift, t[2] + shift}};
}

TEST(WidestGap, IsTheShortestSeparatingTranslation) {
  std::mt19937_64 random(11);
  int overlapping = 0;
  for (int i = 0; i < 20000; ++i) {
    const Triangle a = random_triangle(random, 1), b = random_triangle(random, 1);
    const AxisGap widest = widest_gap(a, b, kAll);
    if (widest.gap >= 0) continue;
    ++overlapping;
    EXPECT_NEAR(widest_gap(a, moved_by(b, -widest.gap * widest.axis), kAll).gap, 0, 1e-12);
    for (int k = 0; k < 20; ++k) {
      const AxisGap other = wider_gap(a, b, normalized(random_vector(random)));
      EXPECT_LE(other.gap, widest.gap + 1e-12);
    }
  }
  EXPECT_GT(overlapping, 1000);
}

TEST(WidestGap, StaysExactForSliversAndNearlyParallelEdges) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> exponent(-12, -1);
  for (int i = 0; i < 20000; ++i) {
    const double tiny = std::pow(10, exponent(random));
    const Vec3 along = random_vector(random);
    const Triangle a{{-1.0 * along, along, along + tiny * random_vector(random)}};
    const Vec3 nearly = along + tiny * random_vector(random);
    const Triangle b{{-1.0 * nearly, nearly, random_vector(random)}};
    const double gap = widest_gap(a, b, kAll).gap;
    // No direction near the best one is better.
    const Vec3 best = widest_gap(a, b, kAll).axis;
    for (int k = 0; k < 50; ++k) {
      const double turn = std::pow(10, exponent(random));
      const AxisGap other = wider_gap(a, b, normalized(best + turn * random_vector(random)));
      EXPECT_LE(std::min(other.gap, 0.0), std::max(gap, 0.0) + std::min(gap, 0.0) + 1e-13 * 10);
    }
  }
}

TEST(WidestGap, OfCoplanarTrianglesIsTheirDistanceOrNothing) {
  const Triangle a{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_EQ(widest_gap(a, a, kAll).gap, 0);
  EXPECT_EQ(widest_gap(a, moved_by(a, {0.1, 0.1, 0}), kAll).gap, 0);
  EXPECT_NEAR(widest_gap(a, moved_by(a, {3, 0, 0}), kAll).gap, 2, 1e-15);
}

TEST(WidestGap, OfDegenerateTrianglesIsStillABound) {
  const Triangle point{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}};
  const Triangle floor{{{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}};
  EXPECT_DOUBLE_EQ(widest_gap(floor, point, kAll).gap, 1);
  const Triangle needle{{{0, 0, -1}, {0, 0, 3}, {0, 0, 3}}};
  EXPECT_DOUBLE_EQ(widest_gap(floor, needle, kAll).gap, -1);
}

}  // namespace
}  // namespace dismantle::audit
