// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/solid_depth.h"

#include "tests/support/depth_oracle.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/shaped_solid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

constexpr double kGap = 1e-3;
const double kPi = std::acos(-1.0);

using Solid = scenes::ShapedSolid;

SolidDepth depth_of(const TriangleMesh& a, const TriangleMesh& b) {
  const Solid first(a), second(b);
  return solid_depth({&first.shape, {}}, {&second.shape, {}});
}

double allowed_excess(double depth) {
  return std::max(kGap, 0.01 * depth);
}

/// Expects the exact depth, to within the bound, and that it is attained.
void expect_depth(const TriangleMesh& a, const TriangleMesh& b, double truth) {
  for (const bool swapped : {false, true}) {
    const SolidDepth found = swapped ? depth_of(b, a) : depth_of(a, b);
    EXPECT_GE(found.depth, truth - 1e-9);
    EXPECT_LE(found.depth, truth + allowed_excess(truth));
    EXPECT_LE(found.attained, truth + 1e-9);
    EXPECT_GE(found.attained, found.depth - allowed_excess(found.attained) - 1e-12);
    EXPECT_FALSE(found.capped);
  }
}

/// A solid cylinder along x.
TriangleMesh rod_x(double radius, double half, std::uint32_t sides) {
  TriangleMesh m = scenes::tube(radius, 0, -half, half, sides);
  for (Vec3& p : m.vertices) p = {p.z, p.x, p.y};
  return m;
}

TriangleMesh lifted(TriangleMesh m, Vec3 by) {
  for (Vec3& p : m.vertices) p += by;
  return m;
}

/// A convex polyhedron: a stretched cube whose faces are finely divided and pushed out onto an ellipsoid.
TriangleMesh pebble(std::mt19937_64& random, std::uint32_t sides) {
  std::uniform_real_distribution<double> u(1, 3);
  TriangleMesh m = scenes::tube(1, 0, -1, 1, sides, 3);
  const Vec3 size{u(random), u(random), u(random)};
  for (Vec3& p : m.vertices)
    p = {size.x * p.x * (1.3 - 0.3 * p.z * p.z), size.y * p.y * (1.3 - 0.3 * p.z * p.z), size.z * p.z};
  return m;
}

/// Expects what the oracle bounds from both sides. @pre closed meshes
void expect_oracle(const TriangleMesh& a, const TriangleMesh& b, double step) {
  const SolidDepth found = depth_of(a, b);
  const oracle::SampledDepth truth = oracle::sampled_depth(a, b, step);
  EXPECT_GE(found.depth, truth.depth - 1e-9);
  EXPECT_LE(found.attained, truth.depth + truth.spacing + 1e-9);
  EXPECT_LE(found.depth, found.attained + allowed_excess(found.attained) + 1e-12);
  EXPECT_FALSE(found.capped);
  if (found.attained == 0) return;
  const TriangleMesh& outer = found.of_b ? a : b;
  const TriangleMesh& inner = found.of_b ? b : a;
  EXPECT_NEAR(oracle::distance(outer, found.deepest_at), found.attained, 1e-9);
  EXPECT_NEAR(oracle::distance(inner, found.deepest_at), 0, 1e-9);
  EXPECT_GT(std::abs(oracle::winding_number(outer, found.deepest_at)), found.attained > 1e-6 ? 0.5 : 0.0);
}

TEST(SolidDepth, OfACornerInABoxIsItsDistanceFromTheNearestFace) {
  const TriangleMesh box = scenes::box({0, 0, 0}, {10, 10, 10});
  expect_depth(box, scenes::box({8, 7, 6}, {20, 20, 20}), 2);
  expect_depth(box, scenes::box({-5, 4, 4}, {3, 6, 6}), 3);
  expect_depth(box, scenes::box({-5, 4, 4}, {15, 6, 6}), 4);  // right through it
}

TEST(SolidDepth, OfRodsThatCrossIsTheInscribedRadiusWhateverTheTessellation) {
  for (const std::uint32_t sides : {8u, 12u, 32u, 48u}) {
    // The top line of one rod lies on the axis of the other one's height, 5 mm above its axis at most.
    const TriangleMesh x = rod_x(5, 50, sides);
    TriangleMesh y = x;
    for (Vec3& p : y.vertices) p = {-p.y, p.x, p.z};
    if (sides < 30) expect_oracle(x, y, 2.5);
    const double depth = depth_of(x, y).depth;
    EXPECT_LE(depth, 5.05);
    EXPECT_GE(depth, 5 * std::cos(kPi / sides) - 1e-9);
  }
}

TEST(SolidDepth, OfAPegInASmallerHoleIsTheDifferenceOfTheRadii) {
  // Both have edges at the same angles: those of the hole stand out into the solid.
  const TriangleMesh hole = scenes::tube(12, 3.3, 0, 20, 24), peg = scenes::tube(4, 0, 2, 35, 24);
  expect_depth(hole, peg, 0.7);
}

TEST(SolidDepth, OfABallInABoxIsThatOfItsLowestPoint) {
  TriangleMesh ball = scenes::tube(1, 0, -1, 1, 16, 8);
  for (Vec3& p : ball.vertices) {
    const double r = std::sqrt(std::max(0.0, 1 - p.z * p.z));
    p = {r * p.x, r * p.y, p.z};
  }
  ball = clean_mesh(ball).mesh;
  expect_depth(lifted(ball, {0.3, 0.2, 0.6}), scenes::box({-20, -20, -20}, {20, 20, 0}), 0.4);
}

TEST(SolidDepth, OfCoincidentFacesIsZeroAndTakesNoTime) {
  const TriangleMesh box = scenes::box({0, 0, 0}, {10, 10, 10});
  for (const TriangleMesh& other :
       {scenes::box({0, 0, 10}, {10, 10, 20}), scenes::box({3, 3, 10}, {30, 4, 20}),
        scenes::box({10, 10, 10}, {20, 20, 20}), lifted(scenes::tube(4, 2, 10, 20, 48, 5), {5, 5, 0}),
        lifted(scenes::tube(4, 2, 10, 20, 48, 5), {5, 0, 0})}) {
    expect_depth(box, other, 0);
    EXPECT_LT(depth_of(box, other).pieces, 4000u);
  }
  expect_depth(scenes::tube(10, 5, 0, 10, 48), scenes::tube(5, 0, 0, 12, 48), 0);  // a fit without clearance
}

TEST(SolidDepth, StaysZeroWhereTurnedFacesCoincideUpToRounding) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 40; ++round) {
    const Pose pose = scenes::random_pose(random, 300, 3);
    const TriangleMesh box = scenes::moved(scenes::box({0, 0, 0}, {100, 80, 10}), pose);
    const TriangleMesh nut = scenes::moved(lifted(scenes::tube(4, 2, 10, 14, 6), {round * 2.5, 30, 0}), pose);
    expect_depth(box, nut, 0);
  }
}

TEST(SolidDepth, IsThatOfDenseSamplesForTumblingPolyhedra) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 24; ++round) {
    const TriangleMesh a = pebble(random, 5 + round % 7);
    const TriangleMesh b = scenes::moved(pebble(random, 9), scenes::random_pose(random, 2, 3));
    expect_oracle(a, b, 0.15);
  }
}

TEST(SolidDepth, DoesNotDependOnTheFrame) {
  std::mt19937_64 random(8);
  const Solid a(scenes::tube(3, 1, -2, 2, 12, 2)), b(scenes::tube(0.9, 0, -20, 20, 9));
  for (int round = 0; round < 10; ++round) {
    const RigidTransform b_from = transform_from_pose(scenes::random_pose(random, 2, 3));
    const RigidTransform world = transform_from_pose(scenes::random_pose(random, 500, 3));
    const SolidDepth there = solid_depth({&a.shape, {}}, {&b.shape, b_from});
    const SolidDepth moved = solid_depth({&a.shape, world}, {&b.shape, world * b_from});
    EXPECT_NEAR(there.depth, moved.depth, 2 * allowed_excess(there.depth));
    EXPECT_EQ(there.attained > kGap, moved.attained > kGap);
  }
}

TEST(SolidDepth, CountsCrackedAndInsideOutMeshesAsSolids) {
  const TriangleMesh hole = scenes::tube(12, 3.3, 0, 20, 24), peg = scenes::tube(4, 0, 2, 35, 24);
  for (std::size_t face = 0; face < 96; face += 7)
    expect_depth(scenes::with_t_junction(hole, face), scenes::with_t_junction(peg, face % 72), 0.7);
  expect_depth(scenes::inside_out(hole), peg, 0.7);
  expect_depth(scenes::inside_out(hole), scenes::inside_out(peg), 0.7);
}

TEST(SolidDepth, CountsMeshesWithHolesByTheirWindingNumber) {
  std::mt19937_64 random(9);
  const TriangleMesh tube = scenes::tube(3, 1, -4, 4, 14, 2);
  for (int round = 0; round < 10; ++round) {
    const TriangleMesh a = scenes::without_face(tube, random() % tube.faces.size());
    TriangleMesh b = scenes::moved(tube, scenes::random_pose(random, 3, 3));
    if (round % 2 == 0) b = scenes::without_face(b, random() % b.faces.size());
    const SolidDepth found = depth_of(a, b);
    const oracle::SampledDepth sampled = oracle::sampled_depth(a, b, 0.4);
    EXPECT_GE(found.depth, sampled.depth - 1e-9);
    EXPECT_LE(found.depth, found.attained + allowed_excess(found.attained) + 1e-12);
    if (found.attained > kGap) {
      const TriangleMesh& outer = found.of_b ? a : b;
      EXPECT_GT(std::abs(oracle::winding_number(outer, found.deepest_at)), 0.5 - 1e-9);
      EXPECT_NEAR(oracle::distance(outer, found.deepest_at), found.attained, 1e-9);
    }
  }
}

TEST(SolidDepth, OfTornMeshesIsNearlyThatOfWholeOnes) {
  const TriangleMesh hole = scenes::tube(12, 3.3, 0, 20, 24), peg = scenes::tube(4, 0, 2, 35, 24);
  const SolidDepth found = depth_of(scenes::torn_apart(hole, 1e-4), scenes::torn_apart(peg, 1e-4));
  EXPECT_NEAR(found.attained, 0.7, 0.02);
  EXPECT_GE(found.depth, found.attained);
}

TEST(SolidDepth, OfASheetIsThatOfItsPointsInTheSolid) {
  const TriangleMesh cube = scenes::box({-20, -20, -20}, {20, 20, 0});
  expect_depth(cube, scenes::sheet(3, -0.5), 0.5);
  expect_depth(cube, scenes::inside_out(scenes::sheet(3, -0.5)), 0.5);
  expect_depth(cube, scenes::sheet(30, -4), 4);
  expect_depth(cube, scenes::sheet(3, 0), 0);  // right above a sheet the winding number is 1/2
  expect_depth(cube, scenes::sheet(3, 0.005), 0);
}

TEST(SolidDepth, IsZeroInAVoidThatAShellBounds) {
  const TriangleMesh shell = scenes::joined(scenes::box({-10, -10, -10}, {10, 10, 10}),
                                            scenes::inside_out(scenes::box({-5, -5, -5}, {5, 5, 5})));
  expect_depth(shell, scenes::box({-2, -2, -2}, {2, 2, 2}), 0);
  expect_depth(shell, scenes::box({-2, -2, -2}, {2, 2, 7}), 2);
}

TEST(SolidDepth, OfNeedlesAndConesIsThatOfTheirTips) {
  for (const double half_angle : {1.0, 10.0, 40.0})
    for (const std::uint32_t sides : {4u, 24u}) {
      TriangleMesh cone = scenes::tube(1, 0, 0, 30, sides);
      const double slope = std::tan(half_angle * kPi / 180);
      for (Vec3& p : cone.vertices) p = {p.x * p.z * slope, p.y * p.z * slope, p.z};
      cone = lifted(clean_mesh(cone).mesh, {0.1, 0.1, -0.37});
      expect_depth(scenes::box({-20, -20, -20}, {20, 20, 0}), cone, 0.37);
    }
}

TEST(SolidDepth, IsAnUpperBoundWhereTheSearchEndsEarly) {
  const Solid a(rod_x(5, 50, 32)), b(scenes::tube(5, 0, -50, 50, 32));
  double last = 1e9;
  for (const std::size_t pieces : {1u, 10u, 100u, 1000u}) {
    DepthOptions options;
    options.pieces = pieces;
    const SolidDepth found = solid_depth({&a.shape, {}}, {&b.shape, {}}, options);
    EXPECT_GE(found.depth, 5 * std::cos(kPi / 32));
    EXPECT_LE(found.depth, last);
    last = found.depth;
  }
}

TEST(SolidContains, HoldsForWhatLiesWithinAndNothingElse) {
  const Solid block(scenes::box({0, 0, 0}, {10, 10, 10})), within(scenes::box({2, 2, 2}, {5, 5, 5})),
      flush(scenes::box({2, 2, 0}, {5, 5, 10})), out(scenes::box({2, 2, 2}, {5, 5, 10.5}));
  const auto contains = [](const Solid& outer, const Solid& inner) {
    return solid_contains({&outer.shape, {}}, {&inner.shape, {}}, 0.01);
  };
  EXPECT_TRUE(contains(block, within));
  EXPECT_TRUE(contains(block, flush));
  EXPECT_TRUE(contains(block, block));
  EXPECT_FALSE(contains(block, out));
  EXPECT_FALSE(contains(within, block));
  const Solid shell(scenes::joined(scenes::box({-10, -10, -10}, {20, 20, 20}),
                                   scenes::inside_out(scenes::box({1, 1, 1}, {9, 9, 9}))));
  EXPECT_FALSE(contains(shell, within));
  EXPECT_FALSE(contains(shell, block));
}

}  // namespace
}  // namespace dismantle
