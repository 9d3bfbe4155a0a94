// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/path.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Path two_moves() {
  Path path;
  path.components = {"pin", "plate"};
  path.moves = {{"pull pin", {"pin"}, {{0, {}}, {0.25, {{0, 0, 3}, {}}}, {1, {{0, 0, 40}, {}}}}},
                {"lift plate", {"plate"}, {{0, {}}, {2, {{0, 0, 9}, {}}}}}};
  path.removed = {"pin"};
  return path;
}

TEST(Path, ReturnsToItsStartThereAndBack) {
  const Path path = two_moves(), both = there_and_back(path);
  ASSERT_EQ(both.moves.size(), 4u);
  EXPECT_EQ(both.moves[0], path.moves[0]);
  EXPECT_EQ(both.moves[1], path.moves[1]);
  EXPECT_EQ(both.moves[2].label, "lift plate, reversed");
  EXPECT_EQ(both.moves[3].components, path.moves[0].components);
  EXPECT_EQ(both.moves[3].frames, (std::vector<Frame>{{0, {{0, 0, 40}, {}}}, {0.75, {{0, 0, 3}, {}}}, {1, {}}}));
  EXPECT_TRUE(both.removed.empty()) << "nothing remains removed";
  EXPECT_EQ(both.components, path.components);
}

TEST(Path, OfNoMovesHasNoReturn) {
  EXPECT_EQ(there_and_back(Path{}), Path{});
}

}  // namespace
}  // namespace dismantle
