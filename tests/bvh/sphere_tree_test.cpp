// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/sphere_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace dismantle {
namespace {

std::vector<BoundingSphere> random_spheres(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-1000, 1000), size(-2, 2);
  std::vector<BoundingSphere> spheres;
  for (std::size_t k = 0; k < count; ++k)
    spheres.push_back({{place(random), place(random), place(random)}, std::pow(10, size(random))});
  return spheres;
}

/// Gap between a sphere and a point.
double gap(const BoundingSphere& sphere, const Vec3& point) {
  return length(sphere.center - point) - sphere.radius;
}

TEST(SphereTree, VisitsAllThatTheBoundAdmits) {
  for (const std::size_t count : {0u, 1u, 4u, 5u, 100u, 1000u}) {
    const std::vector<BoundingSphere> spheres = random_spheres(count, 3 + count);
    const SphereTree tree(spheres);
    const Vec3 point{100, -200, 300};
    std::vector<std::uint32_t> expected, found;
    for (std::uint32_t k = 0; k < count; ++k)
      if (gap(spheres[k], point) <= 200) expected.push_back(k);
    std::size_t visited = 0;
    tree.traverse([&](const BoundingSphere& s) { return gap(s, point); }, [] { return 200.0; },
                  [&](std::uint32_t k) {
                    ++visited;
                    if (gap(spheres[k], point) <= 200) found.push_back(k);
                  });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << count << " spheres";
    EXPECT_LT(visited, 10 + count / 5) << "most are not near";
  }
}

TEST(SphereTree, FindsTheNearestOfManyByAFallingLimit) {
  const std::vector<BoundingSphere> spheres = random_spheres(5000, 1);
  const SphereTree tree(spheres);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-1200, 1200);
  for (int round = 0; round < 50; ++round) {
    const Vec3 point{place(random), place(random), place(random)};
    double expected = std::numeric_limits<double>::infinity(), nearest = expected;
    for (const BoundingSphere& s : spheres) expected = std::min(expected, gap(s, point));
    tree.traverse([&](const BoundingSphere& s) { return gap(s, point); }, [&] { return nearest; },
                  [&](std::uint32_t k) { nearest = std::min(nearest, gap(spheres[k], point)); });
    EXPECT_EQ(nearest, expected);
  }
}

}  // namespace
}  // namespace dismantle
