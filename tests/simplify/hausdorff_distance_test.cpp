// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/hausdorff_distance.h"

#include "dismantle/surface/surface_tree.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dismantle {
namespace {

/// The maximum distance from samples of `from` to `to`, with `side` samples along an edge.
double sampled_distance(const TriangleMesh& from, const TriangleMesh& to, int side) {
  const SurfaceTree tree(to);
  double largest = 0;
  for (std::size_t f = 0; f < from.faces.size(); ++f) {
    const Triangle t = from.triangle(f);
    for (int a = 0; a <= side; ++a)
      for (int b = 0; a + b <= side; ++b)
        largest = std::max(largest, tree.distance(t[0] + static_cast<double>(a) / side * (t[1] - t[0]) +
                                                  static_cast<double>(b) / side * (t[2] - t[0]))
                                        .distance);
  }
  return largest;
}

TEST(HausdorffDistance, OfAMeshToItselfIsNone) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 10, 24, 3);
  const DistanceBounds d = hausdorff_distance(mesh, mesh);
  EXPECT_LE(d.lower, 1e-14);
  EXPECT_LE(d.upper, 1e-11);
}

TEST(HausdorffDistance, OfBoxesOneInTheOtherIsTheDistanceOfTheirCorners) {
  const TriangleMesh small = scenes::box({-1, -1, -1}, {1, 1, 1});
  const TriangleMesh large = scenes::box({-1, -1, -1}, {4, 5, 1});
  const DistanceBounds there = one_sided_hausdorff_distance(small, large);
  EXPECT_NEAR(there.lower, 1, 0.2) << "the middle of a side of the large box, from its lids";
  EXPECT_GE(there.upper, 1);
  const DistanceBounds back = one_sided_hausdorff_distance(large, small);
  EXPECT_NEAR(back.lower, 5, 1e-12);  // (4, 5) to (1, 1)
  EXPECT_NEAR(back.upper, 5, 0.2 * 5);
  EXPECT_EQ(hausdorff_distance(small, large).upper, std::max(there.upper, back.upper));
}

TEST(HausdorffDistance, FindsADistanceThatNoVertexShows) {
  // The roof's ridge is removed: only the middle of the flat lid is far from it.
  TriangleMesh roof, flat;
  roof.vertices = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}, {0, 0, 3}};
  roof.faces = {{{0, 1, 4}}, {{1, 2, 4}}, {{2, 3, 4}}, {{3, 0, 4}}};
  flat.vertices = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}};
  flat.faces = {{{0, 1, 2}}, {{0, 2, 3}}};
  const DistanceBounds d = one_sided_hausdorff_distance(flat, roof);
  const double exact = 3 * 10 / std::sqrt(100.0 + 9.0);  // the middle of the lid to a slope
  EXPECT_LE(d.lower, exact * (1 + 1e-12));
  EXPECT_GE(d.upper, exact);
  EXPECT_GE(d.lower, exact * 0.8);
  EXPECT_LE(d.upper, d.lower * 1.2 + 1e-3);
}

TEST(HausdorffDistance, BoundsEverySampledDistance) {
  std::mt19937 random(17);
  std::normal_distribution<double> noise(0, 1);
  for (const double size : {1e-4, 1e-2, 0.3}) {
    const TriangleMesh fine = scenes::tube(5, 3, 0, 10, 40, 6);
    TriangleMesh coarse = scenes::tube(5, 3, 0, 10, 11, 2);
    for (Vec3& v : coarse.vertices) v += size * Vec3{noise(random), noise(random), noise(random)};
    for (const auto& [from, to] : {std::pair(fine, coarse), std::pair(coarse, fine)}) {
      const DistanceBounds d = one_sided_hausdorff_distance(from, to);
      const double sampled = sampled_distance(from, to, 24);
      EXPECT_GE(d.upper, sampled);
      EXPECT_GE(d.lower, 0.8 * sampled);
      EXPECT_LE(d.upper, 1.06 * d.lower + 1e-3);
    }
  }
}

TEST(HausdorffDistance, StaysABoundWithoutRefinement) {
  HausdorffOptions hasty;
  hasty.pieces = 1;
  const TriangleMesh fine = scenes::tube(5, 3, 0, 10, 40, 6), coarse = scenes::tube(5, 3, 0, 10, 6);
  const DistanceBounds d = hausdorff_distance(fine, coarse, hasty);
  EXPECT_GE(d.upper, sampled_distance(fine, coarse, 16));
  EXPECT_GE(d.upper, sampled_distance(coarse, fine, 64));
}

TEST(HausdorffDistance, IsTheSameOnEveryExecutor) {
  const TriangleMesh fine = scenes::tube(5, 3, 0, 10, 40, 6), coarse = scenes::tube(5, 3, 0, 10, 9);
  HausdorffOptions options;
  const DistanceBounds serial = hausdorff_distance(fine, coarse, options);
  options.executor = Executor(ExecutorKind::Shuffled);
  EXPECT_EQ(hausdorff_distance(fine, coarse, options), serial);
  options.executor = Executor(ExecutorKind::Threads, 3);
  EXPECT_EQ(hausdorff_distance(fine, coarse, options), serial);
}

}  // namespace
}  // namespace dismantle
