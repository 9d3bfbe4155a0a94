// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/separating_ghost.h"

#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/surface/solid_distance.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

/// A block whose top is at z = 0, the larger block on it, and all pairs of their faces.
struct Stack {
  Component components[2];
  SolidTree lower, upper;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;

  Stack()
      : components{scenes::component("lower", scenes::box({-5, -5, -5}, {5, 5, 0})),
                   scenes::component("upper", scenes::box({-8, -8, 0}, {8, 8, 5}))},
        lower(make_solid_tree(components[0], {})),
        upper(make_solid_tree(components[1], {})) {
    for (std::uint32_t f = 0; f < lower.faces.size(); ++f)
      for (std::uint32_t g = 0; g < upper.faces.size(); ++g) pairs.emplace_back(f, g);
  }
  std::optional<std::vector<Vec3>> ghost(Vec3 by, double max_length, double gap) const {
    std::vector<Vec3> start = lower.vertices;
    for (Vec3& p : start) p += by;
    return separating_ghost({&lower, &upper, start, pairs, max_length, gap});
  }
  /// How far the top of a ghost is below the upper block.
  static double gap_of(const std::vector<Vec3>& ghost) {
    return -std::max_element(ghost.begin(), ghost.end(), [](Vec3 p, Vec3 q) { return p.z < q.z; })->z;
  }
};

TEST(SeparatingGhost, DoesNotInsistOnWhereItStarts) {
  const Stack stack;
  // Sideways by all that is allowed: nothing is left for the way down.
  const auto ghost = stack.ghost({0.1, 0, 0}, 0.1, 0.06);
  ASSERT_TRUE(ghost);
  EXPECT_GE(Stack::gap_of(*ghost), 0.03);
}

TEST(SeparatingGhost, TakesDisplacementsThatAreAsLongAsAllowed) {
  const Stack stack;
  std::mt19937_64 random(8);
  for (int i = 0; i < 200; ++i) {
    Vec3 way = normalized(scenes::random_vector(random, 1));
    way.z = -std::abs(way.z);
    const auto ghost = stack.ghost(0.1 * normalized(way), 0.1, 0.06);
    ASSERT_TRUE(ghost) << i;
    EXPECT_GE(Stack::gap_of(*ghost), 0.03);
    for (std::size_t v = 0; v < ghost->size(); ++v)
      EXPECT_LE(length((*ghost)[v] - stack.lower.vertices[v]), 0.1 * (1 + 1e-5));
  }
}

TEST(SeparatingGhost, IsFoundForBlocksOfOneOutlineInMostOrientations) {
  // One block on the other, as files have them: they touch to within rounding only.
  const auto placed = [](TriangleMesh mesh, const Pose& pose) {
    mesh = scenes::moved(std::move(mesh), pose);
    for (Vec3& p : mesh.vertices)
      for (int i = 0; i < 3; ++i) p[i] = static_cast<double>(static_cast<float>(p[i]));
    return scenes::component("block", std::move(mesh));
  };
  const TriangleMesh low = scenes::box({0, 0, 0}, {5, 7, 5}), high = scenes::box({0, 0, 5}, {5, 7, 10});
  constexpr double kGap = 0.002;
  std::mt19937_64 random(17);
  int count = 0;
  for (int k = 0; k < 30; ++k) {
    const Pose pose = scenes::random_pose(random, 100, 3);
    const Component components[] = {placed(low, pose), placed(high, pose)};
    const SolidTree own = make_solid_tree(components[0], {}), other = make_solid_tree(components[1], {});
    std::vector<std::pair<std::uint32_t, std::uint32_t>> near;
    for (std::uint32_t f = 0; f < own.faces.size(); ++f)
      for (std::uint32_t g = 0; g < other.faces.size(); ++g)
        if (distance_triangle_triangle(own.triangle(f), other.triangle(g)).distance < 3 * kGap) near.emplace_back(f, g);
    const auto found = separating_ghost({&own, &other, own.vertices, near, 1.2 * kGap, kGap});
    if (!found) continue;
    ++count;
    const SolidTree ghost = make_displaced_tree(own, *found, {});
    EXPECT_GT(solid_distance({&ghost, {}}, {&other, {}}, 1).distance, 0.4 * kGap) << k;
  }
  EXPECT_GE(count, 25) << "9 where rounding chooses among axes";
}

}  // namespace
}  // namespace dismantle
