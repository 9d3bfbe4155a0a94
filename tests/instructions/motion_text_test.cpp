// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/motion_text.h"

#include "dismantle/math/angle.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// Quarter turns about z with a rise of 1 mm per turn, then a translation.
RemovalMove screwed_out(int quarters) {
  RemovalMove removal{{ComponentId(0)}, {{}}};
  for (int i = 1; i <= quarters; ++i) removal.poses.push_back({{0, 0, 0.25 * i}, quat_about({0, 0, 1}, kTurn / 4 * i)});
  Pose out = removal.poses.back();
  out.position.z += 30;
  removal.poses.push_back(out);
  return removal;
}

std::string text_of(const RemovalMove& removal, PathDirection direction = PathDirection::Forward) {
  return motion_text(legs_of(removal, {1, 2, 3}), direction);
}

TEST(MotionText, NamesTheUpwardDirection) {
  EXPECT_EQ(text_of({{ComponentId(0)}, {{}, {{0, 0, 5}, {}}}}), "Straight up.");
  EXPECT_EQ(text_of({{ComponentId(0)}, {{}, {{0, 0, 5}, {}}}}, PathDirection::Reversed), "Straight down.");
  EXPECT_EQ(text_of({{ComponentId(0)}, {{}, {{-5, 0, 0}, {}}}}), "Straight along -X.");
  EXPECT_EQ(text_of({{ComponentId(0)}, {{}, {{1, 1, 0}, {}}}}), "Straight along the arrow.");
}

TEST(MotionText, CountsTurnsAsTheFitterSeesThem) {
  EXPECT_EQ(
      text_of(screwed_out(18)),
      "Unscrew 4.5 turns anticlockwise (seen from the side where it comes out), moving out 4.5 mm, then straight up.");
  EXPECT_EQ(
      text_of(screwed_out(18), PathDirection::Reversed),
      "Straight down, then screw in 4.5 turns clockwise (seen from the side where it goes in), moving in 4.5 mm.");
}

TEST(MotionText, TellsOfLeftHandedThreads) {
  RemovalMove removal = screwed_out(8);
  for (Pose& pose : removal.poses) pose.rotation = conjugate(pose.rotation);
  EXPECT_EQ(text_of(removal).substr(0, 25), "Unscrew 2 turns clockwise");
}

TEST(MotionText, TellsLegsInTheOrderInWhichTheyAreGone) {
  const RemovalMove removal{{ComponentId(0)}, {{}, {{4, 0, 0}, {}}, {{4, 0, 30}, {}}}};
  EXPECT_EQ(text_of(removal), "Straight along +X by 4 mm, then straight up.");
  EXPECT_EQ(text_of(removal, PathDirection::Reversed), "Straight down, then straight along -X by 4 mm.");
}

TEST(MotionText, SummarisesADrag) {
  RemovalMove removal{{ComponentId(0)}, {{}}};
  for (int i = 1; i <= 40; ++i) removal.poses.push_back({{std::sin(i * 1.0), 0.5 * i, 0}, {}});
  EXPECT_EQ(text_of(removal).substr(0, 16), "Follow the arrow");
}

TEST(MotionText, TellsNumbersForPeople) {
  EXPECT_EQ(number_text(12.3456), "12.3");
  EXPECT_EQ(number_text(0.01234), "0.0123");
  EXPECT_EQ(number_text(12345.6), "12346");
}

TEST(Legs, ThatTurnByHalfATurnAlongTheirAxisScrew) {
  EXPECT_TRUE(is_screwing(legs_of(screwed_out(2), {})[0]));
  EXPECT_FALSE(is_screwing(legs_of(screwed_out(1), {})[0]));
  EXPECT_FALSE(is_screwing(legs_of(screwed_out(2), {})[1]));
}

}  // namespace
}  // namespace dismantle
