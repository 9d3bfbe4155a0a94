// SPDX-License-Identifier: Apache-2.0
#include "dismantle/joints/joint.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(Joint, SaysHowAThreadIsTurned) {
  const Unscrewing right{12, 9.6, 0.8, false, true};
  EXPECT_EQ(unscrewing_text(right), "unscrew 12 turns anticlockwise, 9.6 mm (nominal pitch 0.8 mm)");
  EXPECT_EQ(screwing_in_text(right), "screw in 12 turns clockwise, 9.6 mm (nominal pitch 0.8 mm)");
  const Unscrewing left{2.6, 3.9, 1.5, true, false};
  EXPECT_EQ(unscrewing_text(left), "unscrew 2.5 turns clockwise (left-hand thread), 3.9 mm (pitch 1.5 mm)");
  EXPECT_EQ(screwing_in_text(left), "screw in 2.5 turns anticlockwise (left-hand thread), 3.9 mm (pitch 1.5 mm)");
}

TEST(Joint, SaysNoTurnsWhereThePitchIsUnknown) {
  EXPECT_EQ(unscrewing_text({0, 6, 0, false, true}), "unscrew, 6 mm");
  EXPECT_EQ(unscrewing_text({0.3, 0.24, 0.8, false, true}),
            "unscrew 0.5 turn anticlockwise, 0.24 mm (nominal pitch 0.8 mm)");
}

TEST(Joint, ListsItsStackInTheOrderInWhichItComesOff) {
  Joint joint;
  joint.screw = ComponentId(1);
  joint.nuts = {ComponentId(5)};
  joint.head_washers = {ComponentId(2)};
  joint.nut_washers = {ComponentId(4)};
  const std::vector<ComponentId> expected{ComponentId(5), ComponentId(4), ComponentId(1), ComponentId(2)};
  EXPECT_EQ(joint.stack(), expected);
}

}  // namespace
}  // namespace dismantle
