// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/choose_streams_backend.h"
#include "tests/session/session_table.h"

namespace dismantle {
namespace {

using namespace scenes;

void drag_by_streams(Table& table) {
  ChosenStreamsBackend chosen = choose_streams_backend(table.scene(), {}, DeviceChoice::Cpu);
  table.session().set_drag_engine(
      {make_streams_motion_engine(table.scene(), table.session().pairs(), {}, std::move(chosen.backend)), "streams",
       chosen.device, chosen.failure});
}

TEST(DragEngine, ComputesDragsAndNothingElse) {
  Table table(wall_and_block());
  drag_by_streams(table);
  EXPECT_EQ(table.session().response(), ResponseKind::Touch);
  EXPECT_FALSE(table.session().can_respond(ResponseKind::Slide));
  const StepResult touched = table.drag(kFirst, {30, 20, 0}, 60);
  EXPECT_FALSE(touched.reached);
  EXPECT_FALSE(touched.blocking_pairs.empty());
  EXPECT_LE(touched.pose.position.x, 10.5 + kTableTolerance);
  EXPECT_LT(touched.pose.position.y, 15);  // it does not slide
  EXPECT_FALSE(table.session().engine().contacts(0.1).empty());
  table.session().release();
  EXPECT_TRUE(table.session().take_out(kFirst, Vec3{-1, 0, 0}).ok());
  table.let_run();
  EXPECT_TRUE(table.session().is_removed(ComponentId(0)));
}

TEST(DragEngine, FollowsUndoTakingOutAndPuttingBack) {
  Table table(pinned_plates());
  drag_by_streams(table);
  table.move(kFirst, {0, 0, 12}, 12);
  EXPECT_EQ(table.pose(0).position.z, 12);
  EXPECT_TRUE(table.session().undo().ok());
  const StepResult sideways = table.drag(kFirst, {3, 0, 0}, 3);  // from where undo has put it
  EXPECT_FALSE(sideways.reached);
  table.session().release();
  EXPECT_TRUE(table.session().take_out(kFirst, Vec3{0, 0, 1}).ok());
  table.let_run();
  table.move(kSecond, {0, 0, 5}, 10);
  EXPECT_EQ(table.pose(1).position.z, 5);
  EXPECT_TRUE(table.session().put_back(kSecond).ok());
  table.let_run();
  EXPECT_TRUE(table.session().put_back(kFirst).ok());
  table.let_run();
  EXPECT_EQ(table.pose(0), Pose{});
}

}  // namespace
}  // namespace dismantle
