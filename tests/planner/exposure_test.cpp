// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/exposure.h"

#include "tests/planner/plan_scenes.h"
#include "tests/support/faulty_meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// A case of plates with walls of 1 mm around a room of 20 mm: "wall 0" has an opening of 4 mm by 4 mm in its middle,
/// "wall 5" is the lid. A small box is inside, opposite the opening.
Assembly case_with_an_opening() {
  const auto plate_with_hole = scenes::box_block({{{-11, -10}, {-10, -2, 2, 10}, {-10, -2, 2, 10}}},
                                                 [](int, int y, int z) { return y != 1 || z != 1; });
  return scenes::assembly({scenes::component("wall 0", plate_with_hole),
                           scenes::component("wall 1", scenes::box({10, -10, -10}, {11, 10, 10})),
                           scenes::component("wall 2", scenes::box({-11, -11, -10}, {11, -10, 10})),
                           scenes::component("wall 3", scenes::box({-11, 10, -10}, {11, 11, 10})),
                           scenes::component("wall 4", scenes::box({-11, -11, -11}, {11, 11, -10})),
                           scenes::component("wall 5", scenes::box({-11, -11, 10}, {11, 11, 11})),
                           scenes::component("inside", scenes::box({7, -1, -1}, {9, 1, 1}))});
}

class ExposureTest : public testing::Test {
 protected:
  void use(Assembly assembly) {
    assembly_ = std::move(assembly);
    features_ = shape_features(assembly_, Executor{});
    exposure_ = std::make_unique<Exposure>(assembly_, features_);
    present_ = ComponentSet::all(assembly_.components.size());
  }
  bool is_exposed(const std::string& name) { return exposure_->is_exposed(*assembly_.find(name), present_); }

  Assembly assembly_;
  std::vector<ShapeFeatures> features_;
  std::unique_ptr<Exposure> exposure_;
  ComponentSet present_{0};
};

TEST_F(ExposureTest, IsWhatLiesOpen) {
  use(case_with_an_opening());
  for (const char* wall : {"wall 0", "wall 1", "wall 2", "wall 3", "wall 4", "wall 5"}) EXPECT_TRUE(is_exposed(wall));
  EXPECT_FALSE(is_exposed("inside"));
  EXPECT_FALSE(is_exposed("inside"));
}

TEST_F(ExposureTest, GrowsWhileOthersAreRemoved) {
  use(case_with_an_opening());
  EXPECT_FALSE(is_exposed("inside"));
  present_.erase(*assembly_.find("wall 0"));  // far from the box: a larger opening
  present_.erase(*assembly_.find("wall 5"));
  EXPECT_TRUE(is_exposed("inside"));
}

TEST_F(ExposureTest, NamesWhatHadToBeGone) {
  use(case_with_an_opening());
  const ComponentId inside = *assembly_.find("inside"), lid = *assembly_.find("wall 5"),
                    side = *assembly_.find("wall 2");
  EXPECT_FALSE(exposure_->opened_by(inside, present_, ComponentSet(present_.universe())));
  ComponentSet gone(present_.universe());
  for (const ComponentId c : {*assembly_.find("wall 0"), side, lid}) {
    present_.erase(c);
    gone.insert(c);
  }
  const auto opened_by = exposure_->opened_by(inside, present_, gone);
  ASSERT_TRUE(opened_by);
  ASSERT_EQ(opened_by->size(), 1u) << "one wall is enough";
  EXPECT_TRUE(opened_by->front() == lid || opened_by->front() == side);
  // Whatever else of these is still there.
  present_ = ComponentSet::all(present_.universe());
  present_.erase(opened_by->front());
  EXPECT_TRUE(is_exposed("inside"));
}

TEST_F(ExposureTest, IsTheSameInAnyOrientationAndSize) {
  for (const double scale : {1e-3, 1.0, 1e4}) {
    use(scenes::placed(case_with_an_opening(), {{5, 6, 7}, quat_about(normalized(Vec3{1, 2, 3}), 1.1)}, scale));
    EXPECT_FALSE(is_exposed("inside"));
    EXPECT_TRUE(is_exposed("wall 3"));
  }
}

TEST_F(ExposureTest, IsTheEndOfAPinInABlindHole) {
  const TriangleMesh block = scenes::moved(scenes::tube(20, 1, 0, 60, 32), {});
  use(scenes::assembly({scenes::component("block", block),
                        scenes::component("floor", scenes::box({-20, -20, -5}, {20, 20, 0})),
                        scenes::component("pin", scenes::extruded(scenes::circle(1, 32), 0, 60)),
                        scenes::component("deep", scenes::extruded(scenes::circle(0.5, 8), -3, -2))}));
  EXPECT_TRUE(is_exposed("pin"));
  EXPECT_FALSE(is_exposed("deep"));
}

TEST_F(ExposureTest, DoesNotDependOnTheSideOfFaces) {
  Assembly assembly = case_with_an_opening();
  assembly.components[5] = scenes::component("wall 5", scenes::inside_out(scenes::box({-11, -11, 10}, {11, 11, 11})));
  assembly.components[6] = scenes::component("inside", scenes::inside_out(scenes::box({7, -1, -1}, {9, 1, 1})));
  assembly.components.push_back(scenes::component("sheet inside", scenes::sheet(5, 0)));
  assembly.components.push_back(scenes::component("sheet", scenes::sheet(5, 12)));
  assembly.components.push_back(scenes::component("turned sheet", scenes::inside_out(scenes::sheet(5, 14))));
  use(std::move(assembly));
  EXPECT_TRUE(is_exposed("wall 5"));
  EXPECT_FALSE(is_exposed("inside"));
  EXPECT_FALSE(is_exposed("sheet inside"));
  EXPECT_TRUE(is_exposed("sheet"));
  EXPECT_TRUE(is_exposed("turned sheet"));
}

TEST(PlanDisassembly, OpensACaseBeforeItTakesPartsThroughAnOpening) {
  for (const std::vector<StepPreference>& preferences :
       {std::vector<StepPreference>{}, std::vector<StepPreference>{StepPreference::Groups}}) {
    const scenes::PlanScene scene = scenes::plan_scene(case_with_an_opening());
    const ComponentId inside = *scene.assembly.find("inside");
    PlanOptions options;
    options.preferences = preferences;
    options.targets = {inside};
    EXPECT_EQ(plan_disassembly(scene.assembly, scene.pairs, options).steps.size(), 1u);  // through the opening
    options.targets.clear();
    const Plan plan = plan_disassembly(scene.assembly, scene.pairs, options);
    EXPECT_TRUE(plan.complete());
    ASSERT_EQ(plan.steps.size(), 6u);
    EXPECT_NE(plan.steps[0].components.front(), inside);
  }
}

}  // namespace
}  // namespace dismantle
