// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/search_tree.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(SearchTree, FindsTheNearestConfigurationAndItsPath) {
  std::mt19937_64 random(4);
  SearchTree tree({1, 2, 3}, 5);
  std::vector<std::vector<Pose>> paths(1);
  for (int k = 0; k < 60; ++k) {
    const std::size_t from = random() % tree.size();
    std::vector<Pose> part;
    for (int i = 0; i <= k % 3; ++i) part.push_back(scenes::random_pose(random, 20, 3));
    std::vector<Pose> path = paths[from];
    path.insert(path.end(), part.begin(), part.end());
    paths.push_back(path);
    tree.add({part.back(), from, part});
  }
  for (std::size_t k = 0; k < tree.size(); ++k) EXPECT_EQ(tree.path_to(k), paths[k]);
  for (int k = 0; k < 100; ++k) {
    const Pose pose = scenes::random_pose(random, 20, 3);
    const auto [index, distance] = tree.nearest(pose);
    EXPECT_EQ(tree.distance(tree[index].pose, pose), distance);
    for (std::size_t i = 0; i < tree.size(); ++i) EXPECT_LE(distance, tree.distance(tree[i].pose, pose));
  }
}

TEST(SearchTree, CountsWhatTheCenterGoesAndTheRimTurns) {
  const SearchTree tree({1, 0, 0}, 5);
  EXPECT_NEAR(tree.distance({}, {{3, 4, 0}, {}}), 5, 1e-12);
  const Pose turned{{1, 0, 0}, quat_about({0, 0, 1}, 0.2)};
  EXPECT_NEAR(tree.distance({}, turned * Pose{{-1, 0, 0}, {}}), 5 * 0.2, 1e-12) << "about its center";
}

TEST(SearchTree, TellsHowFarTheCenterHasBeen) {
  SearchTree tree({1, 0, 0}, 5);
  EXPECT_EQ(tree.furthest(), std::nullopt);
  const Pose about_center = Pose{{1, 0, 0}, quat_about({0, 0, 1}, 0.2)} * Pose{{-1, 0, 0}, {}};
  tree.add({about_center, 0, {about_center}});
  ASSERT_TRUE(tree.furthest().has_value());
  EXPECT_NEAR(*tree.furthest(), 0, 1e-12);
  tree.add({{{0, 10, 0}, {}}, 0, {}});
  tree.add({{{0, 5, 0}, {}}, 0, {}});
  EXPECT_DOUBLE_EQ(*tree.furthest(), 2);
}

}  // namespace
}  // namespace dismantle
