// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/obb_discrete_engine.h"

#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "tests/support/engine_scene.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using scenes::shift;

Assembly tube_and_peg() {
  return scenes::assembly({scenes::component("tube", scenes::tube(10, 5, 0, 20, 48, 4)),
                           scenes::component("peg", scenes::tube(4.5, 0, 0, 20, 48, 4))});
}

TEST(ObbDiscreteEngine, LooksAtTheTargetAlone) {
  const Assembly assembly = tube_and_peg();
  const auto engine = make_obb_discrete_engine(assembly, {0.01, {}}, ObbDetail::Triangles);
  const ComponentId peg(1);
  engine->grab({&peg, 1});
  EXPECT_TRUE(engine->step(shift(0, 0, 5), ResponseKind::Stop).reached);
  const StepResult blocked = engine->step(shift(3, 0, 5), ResponseKind::Stop);
  EXPECT_FALSE(blocked.reached);
  EXPECT_EQ(blocked.pose, shift(0, 0, 5));
  EXPECT_EQ(blocked.blocking_pairs.size(), 1u);
  EXPECT_TRUE(engine->step(shift(40, 0, 5), ResponseKind::Stop).reached);  // through the wall
  EXPECT_EQ(engine->poses()[1], shift(40, 0, 5));
}

TEST(ObbDiscreteEngine, FillsHolesWhereABoxStandsForAComponent) {
  const Assembly assembly = tube_and_peg();
  const auto engine = make_obb_discrete_engine(assembly, {0.01, {}}, ObbDetail::Boxes);
  const ComponentId peg(1);
  engine->grab({&peg, 1});
  EXPECT_FALSE(engine->step(shift(0, 0, 5), ResponseKind::Stop).reached);
  EXPECT_TRUE(engine->step(shift(0, 0, 21), ResponseKind::Stop).reached);
}

TEST(ObbDiscreteEngine, LeavesOutPairsThatTouchWhenAssembled) {
  const Assembly assembly = tube_and_peg();
  const PairStates states{0.01, {scenes::pair_of(0, 1, PairState::Contact, 0.01)}};
  const auto engine = make_obb_discrete_engine(assembly, states, ObbDetail::Triangles);
  const ComponentId peg(1);
  engine->grab({&peg, 1});
  EXPECT_TRUE(engine->step(shift(3, 0, 5), ResponseKind::Stop).reached);
}

TEST(ObbDiscreteEngine, FindsAnIntersectionWhereSomeTriangleOfTheSetInHandMeetsOneOfTheRest) {
  std::mt19937_64 random(8);
  const Assembly assembly = scenes::random_assembly(random, 8, 4);
  const auto engine = make_obb_discrete_engine(assembly, {0.01, {}}, ObbDetail::Triangles);
  const ComponentId moving(3);
  engine->grab({&moving, 1});
  const TriangleMesh mesh = assembled_mesh(assembly[moving]);
  int free = 0, blocked = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Pose pose = scenes::random_pose(random, 4, 1);
    const TriangleMesh there = scenes::moved(mesh, pose);
    bool meets = false;
    for (std::uint32_t c = 0; c < 8 && !meets; ++c) {
      if (ComponentId(c) == moving) continue;
      const TriangleMesh other = assembled_mesh(assembly[ComponentId(c)]);
      for (std::size_t f = 0; f < there.faces.size(); ++f)
        for (std::size_t g = 0; g < other.faces.size(); ++g)
          meets = meets || intersect_triangle_triangle(there.triangle(f), other.triangle(g));
    }
    ++(meets ? blocked : free);
    ASSERT_EQ(engine->step(pose, ResponseKind::Stop).reached, !meets) << trial;
  }
  EXPECT_GT(free, 10);
  EXPECT_GT(blocked, 10);
}

}  // namespace
}  // namespace dismantle
