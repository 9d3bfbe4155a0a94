// SPDX-License-Identifier: Apache-2.0
// Automatic motions of a session: removing, putting back, playing.
#include "tests/session/session_table.h"

namespace dismantle {
namespace {

using namespace scenes;

const Vec3 kUp{0, 0, 1};

double worst_difference(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, max_abs(a[i].position - b[i].position));
    const Quat p = a[i].rotation, q = b[i].rotation;
    worst = std::max({worst, std::fabs(p.w - q.w), std::fabs(p.x - q.x), std::fabs(p.y - q.y), std::fabs(p.z - q.z)});
  }
  return worst;
}

TEST(SessionTakeOut, LeadsAPinOutOfItsBoreAndMarksItRemoved) {
  Table table(pinned_plates());
  ASSERT_TRUE(table.session().take_out(kFirst, kUp).ok());
  EXPECT_EQ(table.session().activity(), SessionActivity::Automatic);
  EXPECT_GT(table.let_run(), 20);
  EXPECT_TRUE(table.session().is_removed(ComponentId(0)));
  EXPECT_GT(table.pose(0).position.z, 22);
  EXPECT_EQ(table.session().recording().removed, std::vector<std::string>{"pin"});
  EXPECT_EQ(table.session().done().size(), 1u);
  EXPECT_FALSE(table.session().hold(kFirst).ok());
}

TEST(SessionTakeOut, FindsThePathByItself) {
  Table table(pinned_plates());
  ASSERT_TRUE(table.session().take_out(kFirst, {}).ok());
  table.let_run();
  EXPECT_TRUE(table.session().is_removed(ComponentId(0)));
}

TEST(SessionTakeOut, NamesTheObstacle) {
  Table table(pinned_plates());
  const Result<Done> sideways = table.session().take_out(kFirst, Vec3{1, 0, 0});
  ASSERT_FALSE(sideways.ok());
  EXPECT_NE(sideways.error().message.find("'upper' is in the way"), std::string::npos) << sideways.error().message;
  EXPECT_EQ(table.session().activity(), SessionActivity::Idle);
  EXPECT_FALSE(table.session().take_out(kFirst, Vec3{}).ok());
}

TEST(SessionTakeOut, TakesOneAfterAnotherAlongTheSamePath) {
  Table table(pinned_plates());
  for (const std::uint32_t c : {0u, 1u, 2u}) {
    ASSERT_TRUE(table.session().take_out(std::vector<ComponentId>{ComponentId(c)}, kUp).ok()) << c;
    table.let_run();
    EXPECT_TRUE(table.session().is_removed(ComponentId(c)));
  }
  EXPECT_EQ(table.session().recording().removed.size(), 3u);
}

TEST(SessionTakeOut, GoesOnWhereStepsEndEarly) {
  // A foil across the end of a tube: no ghost, and its depth is hard to bound.
  TriangleMesh ring = tube(1.5, 1, 0, 1, 36);
  for (Vec3& p : ring.vertices) p = p + Vec3{0.5, 4, 8};
  CertificateOptions options;
  options.depth_tests = 300;
  options.slide_tests = 1;
  Table table(scenes::assembly({component("foil", box({0, 2.5, 8}, {3, 5.5, 8.02})), component("ring", ring)}), options,
              1e-4);
  Session& session = table.session();
  ASSERT_TRUE(session.hold(kFirst).ok());
  EXPECT_TRUE(session.drag({{2.875, -2.5625, -0.6875}, {}}, 0.01).unfinished);  // else it shows nothing
  session.release();
  if (!session.done().empty()) {
    ASSERT_TRUE(session.undo().ok());
  }
  for (const Vec3& way : {Vec3{0, 0, -1}, Vec3{0.6, -0.4, -0.7}}) {
    ASSERT_TRUE(session.take_out(kFirst, way).ok());
    table.let_run();
    EXPECT_TRUE(session.is_removed(ComponentId(0)));
    for (const double speed : {-4.0, 4.0}) {
      ASSERT_TRUE(session.play(PlaybackSource::Recording, speed).ok());
      table.let_run();
      EXPECT_FALSE(session.playback()->block()) << speed;
    }
    session.stop_playback();
    ASSERT_TRUE(session.undo().ok());
  }
}

TEST(SessionTakeOut, ParksNoFurtherForWhatGoesBesideIt) {
  Table table(scenes::assembly({component("block", box({0, 0, 0}, {10, 10, 10})),
                                component("beside", box({20, 0, 0}, {30, 10, 10})),
                                component("below", box({0, 0, -5}, {10, 10, -1}))}));
  ASSERT_TRUE(table.session().take_out(kSecond, kUp).ok());
  table.let_run();
  EXPECT_LT(table.pose(1).position.z, 12) << "nothing else moves up there";
  ASSERT_TRUE(table.session().take_out(kFirst, kUp).ok());
  table.let_run();
  EXPECT_GT(table.pose(0).position.z, 10 + 4) << "there is room for the next one";
}

TEST(SessionTakeOut, IsUndoneAsOneEntry) {
  Table table(pinned_plates());
  ASSERT_TRUE(table.session().take_out(kFirst, kUp).ok());
  table.let_run();
  EXPECT_TRUE(table.session().undo().ok());
  EXPECT_FALSE(table.session().is_removed(ComponentId(0)));
  EXPECT_EQ(table.pose(0), Pose{});
  EXPECT_TRUE(table.session().redo().ok());
  EXPECT_TRUE(table.session().is_removed(ComponentId(0)));
}

TEST(SessionTakeOut, StopsImmediatelyWhenHalted) {
  Table table(pinned_plates());
  ASSERT_TRUE(table.session().take_out(kFirst, kUp).ok());
  for (int i = 0; i < 10; ++i) table.session().advance(0.02);
  table.session().halt();
  EXPECT_EQ(table.session().activity(), SessionActivity::Idle);
  EXPECT_FALSE(table.session().is_removed(ComponentId(0)));
  EXPECT_GT(table.pose(0).position.z, 0);
  EXPECT_EQ(table.session().done().size(), 1u);
}

/// Straight up by `height`, and then along `exit`.
Removal up_by(std::vector<ComponentId> set, double height, const Vec3& exit) {
  return {std::move(set), {}, {{0, {}}, {0.5, {{0, 0, height}, {}}}}, exit};
}

TEST(SessionTakeOutAlong, TakesSetsOutOneAfterAnother) {
  Table table(pinned_plates());
  ASSERT_TRUE(table.session().take_out_along({up_by(kFirst, 40, kUp), up_by(kSecond, 20, kUp)}).ok());
  table.let_run();
  EXPECT_TRUE(table.session().is_removed(ComponentId(0)));
  EXPECT_TRUE(table.session().is_removed(ComponentId(1)));
  EXPECT_GT(table.pose(0).position.z - 1, table.pose(1).position.z + 20) << "they are put aside in different places";
  EXPECT_EQ(table.session().done().size(), 2u);
  EXPECT_TRUE(table.session().undo().ok());
  EXPECT_FALSE(table.session().is_removed(ComponentId(1)));
}

TEST(SessionTakeOutAlong, TakesASubassemblyOutAndItsPartsFromThere) {
  Table table(pinned_plates());
  ASSERT_TRUE(table.session().take_out_along({up_by(kBoth, 40, kUp), up_by(kFirst, 30, {})}).ok());
  table.let_run();
  EXPECT_TRUE(table.session().is_removed(ComponentId(0)));
  EXPECT_FALSE(table.session().is_removed(ComponentId(1))) << "the subassembly was not out when its part moved";
  EXPECT_NEAR(table.pose(0).position.z, table.pose(1).position.z + 30, 1e-9);
}

TEST(SessionTakeOutAlong, StartsNoFurtherRemovalIfOneIsBlocked) {
  Table table(pinned_plates());
  const Removal down{kSecond, {}, {{0, {}}, {0.5, {{0, 0, -40}, {}}}}, {}};
  ASSERT_TRUE(table.session().take_out_along({down, up_by(kFirst, 40, kUp)}).ok());
  table.let_run();
  EXPECT_FALSE(table.session().is_removed(ComponentId(0)));
  EXPECT_EQ(table.pose(0), Pose{});
}

TEST(SessionTakeOutAlong, EndsAltogetherWhenHalted) {
  Table table(pinned_plates());
  ASSERT_TRUE(table.session().take_out_along({up_by(kFirst, 40, kUp), up_by(kSecond, 40, kUp)}).ok());
  table.session().advance(0.1);
  table.session().halt();
  EXPECT_EQ(table.session().activity(), SessionActivity::Idle);
  EXPECT_EQ(table.session().done().size(), 1u);
}

TEST(SessionTakeOutAlong, RefusesASetThatWasMovedSince) {
  Table table(pinned_plates());
  table.move(kFirst, {0, 0, 1}, 2);
  EXPECT_FALSE(table.session().take_out_along({up_by(kFirst, 40, kUp)}).ok());
  EXPECT_EQ(table.session().activity(), SessionActivity::Idle);
}

TEST(SessionPutBack, ReturnsAlongItsPath) {
  Table table(pinned_plates());
  ASSERT_TRUE(table.session().take_out(kFirst, kUp).ok());
  table.let_run();
  ASSERT_TRUE(table.session().put_back(kFirst).ok());
  table.let_run();
  EXPECT_FALSE(table.session().is_removed(ComponentId(0)));
  EXPECT_EQ(table.pose(0), Pose{});
  EXPECT_TRUE(table.session().recording().removed.empty());
  EXPECT_EQ(table.session().recording().moves.size(), 2u);
  EXPECT_FALSE(table.session().put_back(kFirst).ok());  // it is not removed
}

TEST(SessionPutBack, GoesHomeAfterADragAlongContacts) {
  Table table(pinned_plates());
  table.drag(kFirst, {3, 2, 40}, 80);  // pulled at an angle: it slides in its bore
  table.session().release();
  EXPECT_GT(table.pose(0).position.z, 15);
  ASSERT_TRUE(table.session().put_back(kFirst).ok());
  table.let_run();
  EXPECT_LT(worst_difference(table.poses(), std::vector<Pose>(3)), 1e-9);
}

TEST(SessionPutBack, GoesAsFarAsItIsFree) {
  Table table(wall_and_block());
  table.move(kFirst, {-30, 0, 0}, 30);
  table.move(kSecond, {-25, 0, 0}, 25);  // the wall blocks the block's return now
  ASSERT_TRUE(table.session().put_back(kFirst).ok());
  table.let_run();
  EXPECT_EQ(table.session().activity(), SessionActivity::Idle);
  EXPECT_NEAR(table.pose(0).position.x, -14.5, 0.05);
}

TEST(SessionFreeDirections, GivesTheExitDirectionsAndTheBlockers) {
  Table table(pinned_plates());
  const auto found = table.session().free_directions(kFirst);
  ASSERT_TRUE(found.ok());
  std::size_t free = 0;
  for (const FreeDirection& d : *found) {
    free += d.free;
    EXPECT_EQ(d.free, std::fabs(d.direction.z) > 0.999);
    EXPECT_EQ(d.free, !d.blocked_by.valid());
  }
  EXPECT_EQ(free, 2u);  // up and down
  EXPECT_TRUE(found->front().free);
  EXPECT_FALSE(table.session().free_directions({}).ok());
}

TEST(SessionPlayback, PlaysTheRecordingReversedBackToTheAssembledPoses) {
  Table table(pinned_plates());
  table.drag(kFirst, {3, 2, 60}, 120);
  table.session().release();
  table.move(kSecond, {0, 0, 30}, 30);
  const std::vector<Pose> live = table.poses();
  ASSERT_TRUE(table.session().play(PlaybackSource::Recording, -3).ok());
  table.let_run();
  EXPECT_EQ(table.session().playback()->time(), 0);
  EXPECT_LT(worst_difference(table.poses(), std::vector<Pose>(3)), 1e-9);
  EXPECT_FALSE(table.session().playback()->block()) << table.session().playback()->block()->time;
  ASSERT_TRUE(table.session().play(PlaybackSource::Recording, 2).ok());
  table.let_run();
  EXPECT_EQ(table.poses(), live);  // bit for bit
  table.session().stop_playback();
  EXPECT_EQ(table.poses(), live);
  EXPECT_EQ(table.session().done().size(), 2u);
}

TEST(SessionPlayback, GivesTheSameFramesAtAnySpeed) {
  Table table(pinned_plates());
  table.drag(kFirst, {0, 0, 60}, 60);
  table.session().release();
  for (const double speed : {0.1, 0.37, 1.0, 50.0, -0.2, -1000.0}) {
    ASSERT_TRUE(table.session().play(PlaybackSource::Recording, speed).ok());
    table.let_run();
    EXPECT_EQ(table.session().playback()->time(), speed > 0 ? table.session().playback()->timeline().duration() : 0);
    EXPECT_EQ(table.pose(0).position.z, speed > 0 ? 60 : 0) << speed;
  }
}

TEST(SessionPlayback, ReachesItsEndDespiteRoundedTimes) {
  ASSERT_LT((0.2 + 0.5) - 0.2, 0.5);
  Table table(wall_and_block());
  table.move(kFirst, {-10, 0, 0}, 20);
  table.move(kSecond, {0, 20, 0}, 50);
  for (const double speed : {-4.0, 1.0, -1.0, 4.0}) {
    ASSERT_TRUE(table.session().play(PlaybackSource::Recording, speed).ok());
    table.let_run();
    EXPECT_EQ(table.pose(0).position.x, speed > 0 ? -10 : 0) << speed;
    EXPECT_EQ(table.pose(1).position.y, speed > 0 ? 20 : 0) << speed;
  }
}

TEST(SessionPlayback, SeeksAnywhereAndBack) {
  Table table(wall_and_block());
  table.move(kFirst, {-10, 0, 0}, 10);
  table.move(kSecond, {0, 20, 0}, 20);
  ASSERT_TRUE(table.session().seek(PlaybackSource::Recording, 0.055).ok());
  EXPECT_NEAR(table.pose(0).position.x, -5.5, 1e-9);
  EXPECT_EQ(table.pose(1), Pose{});
  ASSERT_TRUE(table.session().seek(PlaybackSource::Recording, 1e9).ok());
  EXPECT_EQ(table.pose(1).position.y, 20);
  ASSERT_TRUE(table.session().seek(PlaybackSource::Recording, -1).ok());
  EXPECT_EQ(table.poses(), std::vector<Pose>(2));
  EXPECT_FALSE(table.session().hold(kFirst).ok());
  EXPECT_FALSE(table.session().undo().ok());
  table.session().stop_playback();
  EXPECT_EQ(table.pose(0).position.x, -10);
  EXPECT_TRUE(table.session().undo().ok());
}

TEST(SessionPlayback, ShowsWhatWasTakenAwayAtItsTime) {
  Table table(pinned_plates());
  ASSERT_TRUE(table.session().take_out(kFirst, kUp).ok());
  table.let_run();
  ASSERT_TRUE(table.session().seek(PlaybackSource::Recording, 0.5).ok());
  EXPECT_FALSE(table.session().is_removed(ComponentId(0)));
  ASSERT_TRUE(table.session().seek(PlaybackSource::Recording, 1e9).ok());
  EXPECT_TRUE(table.session().is_removed(ComponentId(0)));
}

TEST(SessionPlayback, PlaysAnOverlappingPairApartAndTogetherAgain) {
  Table table(scenes::assembly(
      {component("lump", box({0, 0, 0}, {10, 10, 10})), component("body", box({5, -5, -5}, {30, 15, 15}))}));
  table.move(kFirst, {-20, 0, 0}, 20);
  for (const double speed : {-1.0, 1.0, -1.0}) {
    ASSERT_TRUE(table.session().play(PlaybackSource::Recording, speed).ok());
    table.let_run();
    EXPECT_FALSE(table.session().playback()->block());
    EXPECT_EQ(table.pose(0).position.x, speed > 0 ? -20 : 0);
  }
  table.session().stop_playback();
  EXPECT_EQ(table.pose(0).position.x, -20);
}

TEST(SessionPlayback, HasNothingToPlayAtFirst) {
  Table table(wall_and_block());
  EXPECT_FALSE(table.session().play(PlaybackSource::Recording, 1).ok());
  EXPECT_FALSE(table.session().play(PlaybackSource::Guide, 1).ok());
  EXPECT_FALSE(table.session().seek(PlaybackSource::Recording, 0).ok());
}

Path path_of(const Table& table, const std::string& name, std::vector<Frame> frames) {
  Path path;
  for (const Component& c : table.scene().components) path.components.push_back(c.name);
  path.moves = {{"a move", {name}, std::move(frames)}};
  return path;
}

TEST(SessionGuide, StopsBeforeAWallThatThePathGoesThrough) {
  Table table(wall_and_block());
  std::vector<Frame> frames;
  for (int i = 0; i <= 40; ++i) frames.push_back({0.01 * i, {{1.0 * i, 0, 0}, {}}});
  ASSERT_TRUE(table.session().set_guide("lies", "", path_of(table, "block", frames)).ok());
  ASSERT_TRUE(table.session().play(PlaybackSource::Guide, 1).ok());
  table.let_run();
  const std::optional<PlaybackBlock> block = table.session().playback()->block();
  ASSERT_TRUE(block);
  EXPECT_EQ(block->by, ComponentId(1));
  EXPECT_NEAR(block->time, 0.1, 0.011);
  EXPECT_LT(table.pose(0).position.x, 10.5);
  table.session().stop_playback();
  EXPECT_EQ(table.pose(0), Pose{});
}

TEST(SessionGuide, RefusesPathsOfOtherAssembliesAndTornOnes) {
  Table table(wall_and_block());
  EXPECT_FALSE(table.session().set_guide("a", "", path_of(table, "screw", {{0, {}}})).ok());
  EXPECT_FALSE(table.session().set_guide("a", "", path_of(table, "block", {{0, {{1, 0, 0}, {}}}})).ok());
  EXPECT_TRUE(table.session().set_guide("a", "", path_of(table, "block", {{0, {}}, {1, {{-1, 0, 0}, {}}}})).ok());
  ASSERT_NE(table.session().guide(), nullptr);
  table.session().close_guide();
  EXPECT_EQ(table.session().guide(), nullptr);
}

}  // namespace
}  // namespace dismantle
