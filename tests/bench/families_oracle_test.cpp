// SPDX-License-Identifier: Apache-2.0
// The oracle of soak_families accuses paths that are known to be bad, and no others.
#include "bench/families/depth_search.h"
#include "bench/families/path_judge.h"
#include "bench/families/shapes.h"

#include <gtest/gtest.h>

namespace dismantle::families {
namespace {

constexpr double kTolerance = 0.01;

Verdict judged(const TriangleMesh& moving, const TriangleMesh& fixed, const std::vector<Vec3>& positions) {
  const auto closed = [](const TriangleMesh& mesh) { return clean_mesh(mesh).faults.boundary_edges == 0; };
  const JudgedPair pair{{moving, closed(moving), true}, {fixed, closed(fixed), true}, kTolerance};
  std::vector<Pose> poses{{}};
  for (const Vec3& p : positions) poses.push_back({p, {}});
  return judge(pair, poses, {});
}

TriangleMesh floor_box() {
  return scenes::box({-20, -20, -20}, {20, 20, 0});
}

TEST(FamiliesOracle, AccusesANeedleThatIsTooDeep) {
  const TriangleMesh needle = shifted(spike(4, 0.5, 5), {1, 1, 1});
  for (const double deep : {2.0, 5.0, 50.0}) {
    const Verdict bad = judged(needle, floor_box(), {{0, 0, -1 - deep * kTolerance}});
    EXPECT_TRUE(bad.beyond && bad.passed) << deep;
    EXPECT_NEAR(bad.ratio, deep, 0.1 * deep);
  }
  const Verdict good = judged(needle, floor_box(), {{0, 0, -1 - 0.9 * kTolerance}, {3, 2, -1 - 0.9 * kTolerance}, {}});
  EXPECT_FALSE(good.beyond || good.passed);
}

TEST(FamiliesOracle, AccusesWhatPassesThroughASheet) {
  const TriangleMesh sheet = waved_sheet(3, 2, 0, 0);
  const TriangleMesh cube = shifted(floor_box(), {0, 0, 0});
  EXPECT_TRUE(judged(cube, sheet, {{0, 0, 3}}).passed);
  EXPECT_TRUE(judged(sheet, cube, {{0, 0, -0.5}}).passed);
  EXPECT_FALSE(judged(cube, sheet, {{0, 0, -3}}).passed);
  EXPECT_FALSE(judged(sheet, cube, {{0, 0, 0.5}, {10, 0, 0.5}, {10, 0, 0}, {}}).passed);
}

TEST(FamiliesOracle, AccusesWhatPassesThroughAFoilInOneStep) {
  const TriangleMesh foil = scenes::box({-9, -9, -0.2 * kTolerance}, {9, 9, 0});
  const TriangleMesh weight = scenes::box({-1, -1, 0.5}, {1, 1, 2});
  EXPECT_TRUE(judged(weight, foil, {{0, 0, -9}}).passed);
  EXPECT_TRUE(judged(foil, weight, {{0, 0, 9}}).passed);
  EXPECT_TRUE(judged(weight, foil, {{0.5, 0.2, -0.5}, {0.5, 0.3, -0.52}}).passed);
  EXPECT_FALSE(judged(weight, foil, {{0, 0, -0.5}, {0, 5, -0.505}, {0, 0, 3}}).passed);
  EXPECT_FALSE(judged(weight, foil, {{20, 0, 0}, {20, 0, -9}, {0, 0, -9}}).passed);
}

TEST(FamiliesOracle, GivesAnOverlapItsAllowanceUntilItHasBeenApart) {
  const TriangleMesh block = scenes::box({-1, -1, -0.2}, {1, 1, 3});
  EXPECT_FALSE(judged(block, floor_box(), {{5, 0, 0}, {5, 0, 3}}).beyond);
  EXPECT_TRUE(judged(block, floor_box(), {{5, 0, -0.1}}).beyond);
  EXPECT_TRUE(judged(block, floor_box(), {{0, 0, 0.3}, {0, 0, 0}}).beyond);
}

TEST(FamiliesOracle, FollowsTurns) {
  // A blade that sweeps through a post between two poses that are free.
  const TriangleMesh blade = scenes::box({1, -0.1, 0}, {5, 0.1, 1}), post = scenes::box({-0.2, 2.8, -1}, {0.2, 3.2, 2});
  const JudgedPair pair{{blade, true, true}, {post, true, true}, kTolerance};
  const Vec3 up{0, 0, 1};
  EXPECT_TRUE(judge(pair, {{}, {{}, quat_about(up, 3)}}, {}).passed);
  EXPECT_FALSE(judge(pair, {{}, {{}, quat_about(up, -3)}}, {}).passed);
  EXPECT_FALSE(judge(pair, {{}, {{}, quat_about(up, 1.4)}}, {}).passed);
}

TEST(FamiliesOracle, FindsDepths) {
  const OracleMesh block(scenes::box({-1, -1, -0.3}, {1, 1, 3}), true, true), base(floor_box(), true, true);
  const FoundDepth found = search_depth(block, base, {}, {1e-4});
  EXPECT_NEAR(found.attained, 0.3, 0.004);
  EXPECT_GE(found.bound, 0.3 - 1e-9);
  EXPECT_FALSE(apart(block, base, {}, 0));
  EXPECT_TRUE(apart(block, base, transform_from_pose({{0, 0, 0.4}, {}}), 0.09));
  EXPECT_FALSE(apart(block, base, transform_from_pose({{0, 0, 0.4}, {}}), 0.11));
}

}  // namespace
}  // namespace dismantle::families
