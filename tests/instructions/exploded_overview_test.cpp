// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/exploded_overview.h"

#include "tests/instructions/bolted_lid.h"

#include <set>

namespace dismantle {
namespace {

TEST(ExplodedOverview, HasABalloonAnItemWithinThePicture) {
  const Assembly a = scenes::bolted_lid();
  const ExplodedOverview overview = exploded_overview(a, bill_of_materials(a), 120, 90, Executor());
  EXPECT_EQ(overview.picture.width, 120);
  std::set<std::size_t> items;
  for (const Balloon& balloon : overview.balloons) {
    items.insert(balloon.item);
    for (const PicturePoint& p : {balloon.anchor, balloon.place}) {
      EXPECT_GT(p.x, 0);
      EXPECT_LT(p.x, 1);
      EXPECT_GT(p.y, 0);
      EXPECT_LT(p.y, 1);
    }
    EXPECT_TRUE(balloon.place.x < 0.1 || balloon.place.x > 0.9);
  }
  EXPECT_EQ(items, (std::set<std::size_t>{0, 1, 2}));
}

TEST(ExplodedOverview, OrdersBalloonsAsWhatTheyMark) {
  const Assembly a = scenes::bolted_lid();
  const std::vector<Balloon> balloons = exploded_overview(a, bill_of_materials(a), 120, 90, Executor()).balloons;
  for (std::size_t i = 1; i < balloons.size(); ++i) {
    if (balloons[i].place.x != balloons[i - 1].place.x) continue;
    EXPECT_LE(balloons[i - 1].anchor.y, balloons[i].anchor.y);
    EXPECT_LT(balloons[i - 1].place.y, balloons[i].place.y);
  }
}

}  // namespace
}  // namespace dismantle
