// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/exit_search.h"

#include "tests/session/session_table.h"

namespace dismantle {
namespace {

using namespace scenes;

constexpr double kReach = 3 * kTableTolerance;

//   The block from above, the wall on its right: the box of both is 21 mm long and 100 mm wide.
//
//                     |
//      +---+          |
//      |   |  10.5 mm | wall
//      +---+          |
//      block          |

class ExitSearchBesideAWall : public testing::Test {
 protected:
  const Assembly assembly_ = wall_and_block();
  const PairStates pairs_ = *classify_pairs(assembly_, {});
  CertificateEngine engine_{assembly_, pairs_};
  ExitSearch out() {
    engine_.grab(kFirst);
    return {assembly_, engine_, kFirst};
  }
};

TEST_F(ExitSearchBesideAWall, IsOutsideOnceItsBoxHasLeftThatOfTheAssembly) {
  EXPECT_FALSE(out().is_outside());
  engine_.jump(std::vector<Pose>{{{-10.5, 0, 0}, {}}, {}});
  EXPECT_TRUE(out().is_outside());
  EXPECT_EQ(out().exit_distance({1, 0, 0}), 0);
}

TEST_F(ExitSearchBesideAWall, HasToGoUntilTheWholeBoxIsBehind) {
  const double margin = out().exit_distance({-1, 0, 0}) - 10;
  EXPECT_GT(margin, 0);
  EXPECT_LT(margin, 5);
  EXPECT_NEAR(out().exit_distance({0, 1, 0}), 50 + margin, 1e-9);
  // Along a diagonal it leaves through the side that it reaches first.
  const double slant = std::sqrt(0.5);
  EXPECT_NEAR(out().exit_distance({-slant, slant, 0}), 10 / slant + margin, 1e-9);
}

TEST_F(ExitSearchBesideAWall, FollowsADirectionAsFarAsItIsFree) {
  const std::vector<FreeDirection> directions = out().free_distances(std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}});
  EXPECT_FALSE(directions[0].free);
  EXPECT_EQ(directions[0].blocked_by, ComponentId(1));
  EXPECT_NEAR(directions[0].distance, 10.5, 0.1);
  EXPECT_LE(directions[0].distance, 10.5 + pairs_.tolerance);
  EXPECT_TRUE(directions[1].free);
}

TEST_F(ExitSearchBesideAWall, FindsTheShortestFreePathFirst) {
  const std::vector<FreeDirection> directions = out().find(kReach);
  ASSERT_FALSE(directions.empty());
  EXPECT_TRUE(directions[0].free);
  EXPECT_EQ(directions[0].direction, (Vec3{-1, 0, 0}));
  EXPECT_FALSE(directions.back().free);
  EXPECT_EQ(directions.back().blocked_by, ComponentId(1));
}

TEST_F(ExitSearchBesideAWall, OmitsPathsThatEndBeforeAHundredthOfTheDistance) {
  const auto leads_to_the_wall_from = [&](double gap) {
    engine_.jump(std::vector<Pose>{{{10.5 - gap, 0, 0}, {}}, {}});
    const std::vector<FreeDirection> directions = out().find(kReach);
    return std::any_of(directions.begin(), directions.end(), [](const FreeDirection& w) {
      return w.direction == Vec3{1, 0, 0} && !w.free;
    });
  };
  EXPECT_FALSE(leads_to_the_wall_from(0.1));
  EXPECT_TRUE(leads_to_the_wall_from(1));
}

TEST_F(ExitSearchBesideAWall, LeadsOutwardFromTheMiddle) {
  const Vec3 outward = out().outward();
  EXPECT_NEAR(length(outward), 1, 1e-12);
  EXPECT_LT(outward.x, 0);
}

TEST(ExitSearch, FollowsTheNormalsOfWhatTheSetTouches) {
  const double slant = std::sqrt(0.5);
  const Quat turn = quat_about({0, 0, 1}, std::acos(-1.0) / 4);
  const auto turned = [&](const TriangleMesh& mesh) { return moved(mesh, {{}, turn}); };
  const Assembly assembly = scenes::assembly({component("block", turned(box({0, 0, 0}, {10, 10, 10}))),
                                              component("wall", turned(box({-1, -50, -50}, {0, 50, 50})))});
  const PairStates pairs = *classify_pairs(assembly, {});
  CertificateEngine engine(assembly, pairs);
  engine.grab(kFirst);
  const std::vector<FreeDirection> directions = ExitSearch(assembly, engine, kFirst).find(kReach);
  const bool has_normal = std::any_of(directions.begin(), directions.end(), [&](const FreeDirection& w) {
    return w.free && length(w.direction - Vec3{slant, slant, 0}) < 1e-6;
  });
  EXPECT_TRUE(has_normal);
}

}  // namespace
}  // namespace dismantle
