// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/direction_clusters.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(DirectionClusters, MergesWhatIsAlmostTheSame) {
  DirectionClusters clusters(Sense::Directed);
  clusters.add({1, 0, 0}, 1);
  clusters.add({1, 4e-4, 0}, 1);
  clusters.add({0, 0, 2}, 3);
  clusters.add({0, 0, -2}, 0.5);
  const std::vector<WeightedDirection> found = clusters.heaviest(8);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].direction.z, 1);
  EXPECT_EQ(found[1].weight, 2);
  EXPECT_NEAR(found[1].direction.y, 2e-4, 1e-6);
  EXPECT_EQ(found[2].direction.z, -1);
}

TEST(DirectionClusters, TreatsOppositeDirectionsAsOneAxis) {
  DirectionClusters clusters(Sense::Axis);
  clusters.add({0.6, 0.8, 0}, 1);
  clusters.add({-0.6, -0.8, 0}, 1);
  EXPECT_EQ(clusters.heaviest(8).size(), 1u);
}

TEST(DirectionClusters, KeepsTheHeaviestOnly) {
  DirectionClusters clusters(Sense::Directed);
  for (int k = 1; k <= 20; ++k) clusters.add({1, 0.1 * k, 0}, k);
  const std::vector<WeightedDirection> found = clusters.heaviest(3);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].weight, 20);
  EXPECT_EQ(found[2].weight, 18);
}

}  // namespace
}  // namespace dismantle
