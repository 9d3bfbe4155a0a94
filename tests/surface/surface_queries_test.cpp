// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/surface_queries.h"

#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "tests/support/meshes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dismantle {
namespace {

double brute_force_distance(const TriangleMesh& a, const TriangleMesh& b) {
  double least = 1e300;
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    for (std::size_t g = 0; g < b.faces.size(); ++g)
      least = std::min(least, distance_triangle_triangle(a.triangle(f), b.triangle(g)).distance);
  return least;
}

TEST(NearestOfSurface, IsTheDistanceExceptBelowWhatIsAccepted) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> offset(-0.3, 0.5);
  int met = 0, accepted = 0, apart = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose turned = scenes::random_pose(random, 20, 3);
    const TriangleMesh lower = scenes::moved(scenes::tube(5, 2, 0, 3, 24), turned);
    const double gap = i % 4 == 0 ? offset(random) : i % 4 == 1 ? 1e-7 * offset(random) : std::abs(offset(random));
    const TriangleMesh upper = scenes::moved(scenes::tube(4, 1, 3 + gap, 6, 17), turned);
    const AssemblySurface surface = make_assembly_surface(
        scenes::assembly({scenes::component("lower", lower), scenes::component("upper", upper)}), {});
    const double truth = brute_force_distance(lower, upper), limit = 0.4, below = 0.05;
    const ComponentId a(0), b(1);
    EXPECT_NEAR(nearest_of_surface(surface, a, b, limit).distance, std::min(truth, limit), 1e-12);
    const double found = nearest_of_surface(surface, a, b, limit, below).distance;
    if (truth == 0) {
      EXPECT_EQ(found, 0);
      ++met;
    } else if (truth < below) {
      EXPECT_GE(found, truth - 1e-12);
      EXPECT_LT(found, below);
      ++accepted;
    } else {
      EXPECT_NEAR(found, std::min(truth, limit), 1e-12);
      ++apart;
    }
  }
  EXPECT_GT(met, 20);
  EXPECT_GT(accepted, 20);
  EXPECT_GT(apart, 20);
}

}  // namespace
}  // namespace dismantle
