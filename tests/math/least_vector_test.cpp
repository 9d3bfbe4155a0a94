// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/least_vector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace dismantle {
namespace {

Vec3 random_unit(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return normalized(Vec3{normal(random), normal(random), normal(random)});
}

double most_missed(const std::vector<VectorBound>& bounds, Vec3 v) {
  double missed = 0;
  for (const VectorBound& b : bounds) missed = std::max(missed, b.distance - dot(b.normal, v));
  return missed;
}

TEST(LeastVector, IsZeroWithoutBoundsOrWhereAllAreMetByIt) {
  EXPECT_EQ(*least_vector({}), Vec3{});
  const std::vector<VectorBound> met{{{1, 0, 0}, -1}, {{0, 1, 0}, 0}};
  EXPECT_EQ(*least_vector(met), Vec3{});
}

TEST(LeastVector, RetractsAPlaneAnEdgeAndACorner) {
  std::vector<VectorBound> bounds{{{1, 0, 0}, 1}};
  EXPECT_NEAR(length(*least_vector(bounds)), 1, 1e-12);
  bounds.push_back({{0, 1, 0}, 1});
  EXPECT_NEAR(length(*least_vector(bounds)), std::sqrt(2.0), 1e-12);
  bounds.push_back({{0, 0, 1}, 1});
  EXPECT_NEAR(length(*least_vector(bounds)), std::sqrt(3.0), 1e-12);
  bounds.push_back({normalized(Vec3{1, 1, 1}), 1});  // met already
  EXPECT_NEAR(length(*least_vector(bounds)), std::sqrt(3.0), 1e-12);
}

TEST(LeastVector, FindsNothingWhereBoundsContradictEachOther) {
  EXPECT_FALSE(least_vector(std::vector<VectorBound>{{{1, 0, 0}, 1}, {{-1, 0, 0}, 1}}));
  EXPECT_FALSE(least_vector(
      std::vector<VectorBound>{{{1, 0, 0}, 1}, {normalized(Vec3{-1, 2, 0}), 1}, {normalized(Vec3{-1, -2, 0}), 1}}));
}

/// The shortest vector by brute force: that of every set of up to three bounds met with equality.
std::optional<Vec3> by_enumeration(const std::vector<VectorBound>& bounds) {
  std::optional<Vec3> best;
  const auto take = [&](Vec3 v) {
    if (most_missed(bounds, v) < 1e-7 && (!best || length(v) < length(*best))) best = v;
  };
  take({});
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    take(bounds[i].distance * bounds[i].normal);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 a = bounds[i].normal, b = bounds[j].normal;
      const double c = dot(a, b), square = 1 - c * c;
      if (square < 1e-9) continue;
      take(((bounds[i].distance - c * bounds[j].distance) / square) * a +
           ((bounds[j].distance - c * bounds[i].distance) / square) * b);
      for (std::size_t k = 0; k < j; ++k) {
        const Vec3 d = bounds[k].normal;
        const double volume = dot(a, cross(b, d));
        if (std::abs(volume) < 1e-9) continue;
        take((bounds[i].distance * cross(b, d) + bounds[j].distance * cross(d, a) + bounds[k].distance * cross(a, b)) /
             volume);
      }
    }
  }
  return best;
}

TEST(LeastVector, IsTheShortestOfAllThatMeetTheBounds) {
  std::mt19937_64 random(20261123);
  std::uniform_real_distribution<double> share(0, 1);
  int found = 0, none = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    std::vector<VectorBound> bounds;
    // Half of them around one direction, so that most have a solution.
    const Vec3 towards = random_unit(random);
    const int count = 1 + static_cast<int>(9 * share(random));
    for (int k = 0; k < count; ++k) {
      const Vec3 normal = trial % 2 == 0 ? normalized(random_unit(random) + 1.2 * towards) : random_unit(random);
      bounds.push_back({normal, trial % 3 == 0 ? 1 : 2 * share(random) - 0.5});
    }
    const std::optional<Vec3> least = least_vector(bounds), wanted = by_enumeration(bounds);
    if (wanted && length(*wanted) > 1e3) continue;  // nearly parallel bounds
    ASSERT_EQ(least.has_value(), wanted.has_value()) << "trial " << trial;
    if (!least) {
      ++none;
      continue;
    }
    ++found;
    EXPECT_LT(most_missed(bounds, *least), 1e-6) << "trial " << trial;
    EXPECT_NEAR(length(*least), length(*wanted), 1e-6) << "trial " << trial;
  }
  EXPECT_GT(found, 3000);
  EXPECT_GT(none, 100);
}

}  // namespace
}  // namespace dismantle
