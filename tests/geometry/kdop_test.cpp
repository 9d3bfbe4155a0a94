// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/kdop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dismantle {
namespace {

constexpr unsigned kSeed = 20151;

/// Exact comparison of a float bound with the sum x + sign * y of two doubles: x and y themselves are exact, and the
/// error of the rounded sum is known exactly by Knuth's two-sum.
bool at_most_sum(double bound, double x, double y) {
  const double sum = x + y, part = sum - x;
  const double error = (x - (sum - part)) + (y - part);
  return bound < sum || (bound == sum && error >= 0);
}

bool contains_exactly(const Kdop16& k, Vec3 p) {
  const double pairs[8][2] = {{p.x, 0},   {p.y, 0},   {p.z, 0},    {p.x, p.y},
                              {p.x, p.z}, {p.y, p.z}, {p.x, -p.y}, {p.x, -p.z}};
  for (int i = 0; i < 8; ++i) {
    if (!at_most_sum(k.lower[i], pairs[i][0], pairs[i][1])) return false;
    if (!at_most_sum(-k.upper[i], -pairs[i][0], -pairs[i][1])) return false;
  }
  return true;
}

Vec3 random_point(std::mt19937_64& random) {
  std::uniform_real_distribution<double> exponent(-30, 30), sign(-1, 1);
  const auto coordinate = [&] { return sign(random) * std::pow(10.0, exponent(random) / 5); };
  Vec3 p{coordinate(), coordinate(), coordinate()};
  if (random() % 4 == 0) p.y = std::nextafter(p.x, sign(random));
  if (random() % 4 == 0) p.z = 0;
  return p;
}

TEST(Kdop16, ContainsItsPointsExactlyDespiteRounding) {
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 200'000; ++i) {
    const Vec3 a = random_point(random), b = random_point(random);
    KdopOfPoints points;
    points.extend(a);
    points.extend(b);
    const Kdop16 k = points.rounded_outward(0);
    ASSERT_TRUE(contains_exactly(k, a) && contains_exactly(k, b)) << a.x << " " << a.y << " " << a.z;
  }
}

TEST(Kdop16, IsTightToFloatPrecision) {
  KdopOfPoints points;
  points.extend({1000, -2000, 0.5});
  const Kdop16 k = points.rounded_outward(0);
  EXPECT_LT(k.upper[0] - k.lower[0], 2e-3f);
  EXPECT_LT(k.upper[6] - k.lower[6], 6e-3f);
}

TEST(Kdop16, GrowsByAtLeastTheMarginInSpaceAlongEveryAxis) {
  KdopOfPoints points;
  points.extend({3, 4, 5});
  const Kdop16 plain = points.rounded_outward(0), grown = points.rounded_outward(0.25f);
  for (int k = 0; k < Kdop16::kAxisCount; ++k) {
    const float needed = 0.25f * (k < 3 ? 1.0f : 1.41421f);
    EXPECT_GE(plain.lower[k] - grown.lower[k], needed - 1e-5f);
    EXPECT_GE(grown.upper[k] - plain.upper[k], needed - 1e-5f);
  }
}

TEST(Kdop16, OverlapsWhatItTouches) {
  KdopOfPoints a, b;
  a.extend({0, 0, 0});
  a.extend({1, 1, 1});
  b.extend({1, 1, 1});
  b.extend({2, 2, 2});
  EXPECT_TRUE(overlaps(a.rounded_outward(0), b.rounded_outward(0)));
}

TEST(Kdop16, SeparatesAlongADiagonal) {
  KdopOfPoints a, b;  // two segments along x = -y, whose boxes overlap
  a.extend({0, 1, 0});
  a.extend({1, 0, 0});
  b.extend({0.1, 1.1, 0});
  b.extend({1.1, 0.1, 0});
  EXPECT_FALSE(overlaps(a.rounded_outward(0), b.rounded_outward(0)));
}

TEST(Kdop16, IsEmptyAtFirstAndOverlapsNothingThen) {
  KdopOfPoints point;
  point.extend({0, 0, 0});
  EXPECT_TRUE(Kdop16{}.empty());
  EXPECT_FALSE(overlaps(Kdop16{}, point.rounded_outward(0)));
  EXPECT_EQ(united(Kdop16{}, point.rounded_outward(0)), point.rounded_outward(0));
}

}  // namespace
}  // namespace dismantle
