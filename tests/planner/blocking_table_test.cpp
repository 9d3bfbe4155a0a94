// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/blocking_table.h"

#include "dismantle/planner/search/free_component_search.h"
#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dismantle {
namespace {

constexpr ComponentId kTube(0), kLow(1), kMiddle(2), kHigh(3);

/// Three boxes in a tube that is open at both ends.
class BlockingTableTest : public testing::Test {
 protected:
  DirectionId up() { return table_.add_direction({0, 0, 1}); }
  DirectionId aside() { return table_.add_direction({1, 0, 0}); }

  scenes::PlanScene scene_ = scenes::plan_scene(scenes::stack_in_tube(3));
  CertificateEngine engine_{scene_.assembly, scene_.pairs};
  std::vector<ShapeFeatures> features_ = [this] {
    std::vector<ShapeFeatures> features;
    for (const Component& c : scene_.assembly.components) features.push_back(shape_features(assembled_mesh(c)));
    return features;
  }();
  RigidGroups groups_{scene_.assembly.components.size()};
  BlockingTable table_{engine_, features_, groups_, [] { return true; }};
  ComponentSet all_ = ComponentSet::all(4);
};

TEST_F(BlockingTableTest, KnowsWhatBlocksWhat) {
  EXPECT_TRUE(table_.blocks(kLow, up(), kMiddle));
  EXPECT_TRUE(table_.blocks(kLow, up(), kHigh));
  EXPECT_FALSE(table_.blocks(kLow, up(), kTube)) << "it slides along the walls of the tube";
  EXPECT_FALSE(table_.blocks(kHigh, up(), kLow));
  EXPECT_TRUE(table_.blocks(kLow, table_.opposite(aside()), kTube));
}

TEST_F(BlockingTableTest, IsSymmetricBetweenADirectionAndItsOpposite) {
  for (const DirectionId d : {up(), aside()})
    for (std::uint32_t a = 0; a < 4; ++a)
      for (std::uint32_t b = 0; b < 4; ++b) {
        if (a == b) continue;
        EXPECT_EQ(table_.blocks(ComponentId(a), d, ComponentId(b)),
                  table_.blocks(ComponentId(b), table_.opposite(d), ComponentId(a)));
      }
}

TEST_F(BlockingTableTest, FindsABlockerAsLongAsThereIsOne) {
  EXPECT_EQ(table_.blockers(kLow, up(), all_), (std::vector{kMiddle, kHigh}));
  EXPECT_EQ(table_.blockers(kLow, up(), all_, 1).size(), 1u);
  ComponentSet left = all_;
  left.erase(*table_.any_blocker(kLow, up(), left));
  left.erase(*table_.any_blocker(kLow, up(), left));
  EXPECT_FALSE(table_.any_blocker(kLow, up(), left));
}

TEST_F(BlockingTableTest, FindsWhatGoesTogether) {
  EXPECT_EQ(table_.moving_together(kMiddle, up(), all_), (std::vector{kMiddle, kHigh}));
  EXPECT_EQ(table_.moving_together(kMiddle, aside(), all_), (std::vector{kTube, kLow, kMiddle, kHigh}));
  ComponentSet ends(4, {&kHigh, 1});
  BlockingTable::Together memory(4);
  EXPECT_TRUE(table_
                  .moving_together(
                      kMiddle, up(), all_, ends, [] { return 4; }, memory)
                  .empty());
  EXPECT_EQ(ends.members(), (std::vector{kMiddle, kHigh})) << "the middle one cannot leave without the high one";
  ComponentSet large(4);
  EXPECT_TRUE(table_
                  .moving_together(
                      kLow, up(), all_, large, [] { return 2; }, memory)
                  .empty());
  EXPECT_EQ(large.members(), std::vector{kLow}) << "two of the three can leave";
}

TEST_F(BlockingTableTest, GivesTheFirstContact) {
  const auto contact = table_.contact(kLow, up(), kHigh);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->distance, 4, scene_.pairs.tolerance);
  EXPECT_NEAR(contact->point.z, 8, scene_.pairs.tolerance);
}

TEST_F(BlockingTableTest, LearnsWhatASweepCannotSee) {
  EXPECT_FALSE(table_.any_blocker(kHigh, up(), all_));
  table_.add_blocker(kHigh, up(), kTube);
  EXPECT_EQ(table_.any_blocker(kHigh, up(), all_), kTube);
}

TEST_F(BlockingTableTest, ExpectsWhatItWasToldUntilItKnowsBetter) {
  table_.expect_blockers([](ComponentId c, const Vec3& direction) {
    return c == kLow && direction.z > 0.5 ? std::vector{kTube, kHigh} : std::vector<ComponentId>();
  });
  EXPECT_FALSE(table_.expected_blocker(kLow, aside(), all_));
  EXPECT_EQ(table_.expected_blocker(kLow, up(), all_), kTube);
  EXPECT_EQ(table_.any_blocker(kLow, up(), all_), kHigh) << "expected blockers are tested first";
  ComponentSet left = all_;
  left.erase(kHigh);
  EXPECT_FALSE(table_.expected_blocker(kLow, up(), left)) << "the tube turned out not to block";
}

TEST_F(BlockingTableTest, EvaluatesNothingOnceStopped) {
  bool keep_going = true;
  BlockingTable table(engine_, features_, groups_, [&] { return keep_going; });
  const DirectionId d = table.add_direction({0, 0, 1});
  EXPECT_FALSE(table.blocks(kHigh, d, kTube));
  keep_going = false;
  EXPECT_FALSE(table.blocks(kHigh, d, kTube)) << "it is already known";
  EXPECT_FALSE(table.blocks(kHigh, d, kLow)) << "their bounds tell";
  EXPECT_TRUE(table.blocks(kMiddle, d, kTube));
  keep_going = true;
  EXPECT_FALSE(table.blocks(kMiddle, d, kTube)) << "an unfinished query must not be stored";
}

TEST_F(BlockingTableTest, GivesNearlyEqualDirectionsOneId) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const Vec3 unit = normalized(Vec3{any(random), any(random), any(random)});
    const DirectionId d = table_.add_direction(unit);
    EXPECT_EQ(table_.add_direction(normalized(unit + 4e-7 * Vec3{any(random), any(random), any(random)})), d);
    const Vec3 aside = normalized(cross(unit, std::abs(unit.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    EXPECT_NE(table_.add_direction(normalized(unit + 1e-5 * aside)), d);
  }
}

TEST_F(BlockingTableTest, ExitsPastEverythingInTheWay) {
  const double up_and_out = table_.exit_distance(kLow, up());
  for (const ComponentId c : {kTube, kMiddle, kHigh})
    EXPECT_GE(up_and_out, features_[c.value].center.z + features_[c.value].radius - features_[kLow.value].center.z);
  EXPECT_LE(up_and_out, table_.max_exit_distance(kLow));
}

/// Two rods that cross, whose depth has to be bounded, and an engine that is given up as long as `is_over`.
class PostponedRelations : public testing::Test {
 protected:
  static Assembly rods() {
    const TriangleMesh rod = scenes::tube(1, 0, -10, 10, 12);
    return scenes::assembly(
        {scenes::component("rod", rod),
         scenes::component("across", scenes::moved(rod, {{1.4, 0, 0}, quat_about({1, 0, 0}, kTurn / 4)}))});
  }

  bool is_over_ = false;
  scenes::PlanScene scene_ = scenes::plan_scene(rods());
  CertificateEngine engine_{scene_.assembly, scene_.pairs, [this] {
                              CertificateOptions options;
                              options.keep_going = [this] { return !is_over_; };
                              return options;
                            }()};
  std::vector<ShapeFeatures> features_ = shape_features(scene_.assembly, Executor{});
  RigidGroups groups_{2};
  BlockingTable table_{engine_, features_, groups_, [] { return true; }};
  ComponentId rod_{0}, across_{1};
  ComponentSet all_ = ComponentSet::all(2);
  DirectionId away_ = table_.add_direction({-1, 0, 0});
};

TEST_F(PostponedRelations, BlockUntilTheyAreDecided) {
  table_.postpone_hard(true);
  is_over_ = true;
  EXPECT_EQ(table_.any_blocker(rod_, away_, all_), across_);
  EXPECT_TRUE(table_.is_postponed(rod_, away_, across_));
  is_over_ = false;
  EXPECT_TRUE(table_.blocks(rod_, away_, across_)) << "it is not searched again";
  table_.postpone_hard(false);
  EXPECT_FALSE(table_.any_blocker(rod_, away_, all_));
  EXPECT_FALSE(table_.is_postponed(rod_, away_, across_));
}

TEST_F(PostponedRelations, AreOnlyThoseThatAQuickSearchDoesNotDecide) {
  table_.postpone_hard(true);
  EXPECT_FALSE(table_.blocks(rod_, away_, across_));
  EXPECT_TRUE(table_.blocks(rod_, table_.opposite(away_), across_));
  EXPECT_FALSE(table_.is_postponed(rod_, table_.opposite(away_), across_));
}

TEST_F(PostponedRelations, AreTestedAgainBySearchesForFreeComponents) {
  const DirectionLists directions{{away_}, {}};
  FreeComponentSearch search(table_, directions, all_, ComponentSet(2));
  const auto found = [&] { return search.find(Executor(), [] { return true; }).size(); };
  table_.postpone_hard(true);
  is_over_ = true;
  EXPECT_EQ(found(), 0u);
  is_over_ = false;
  table_.postpone_hard(false);
  EXPECT_EQ(found(), 0u);
  search.retry_postponed();
  EXPECT_EQ(found(), 1u);
}

}  // namespace
}  // namespace dismantle
