// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"

#include "tests/audit/depth_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using depth_scenes::along;
using depth_scenes::audit_pair;
using depth_scenes::blind_hole;
using depth_scenes::block;
using depth_scenes::circle;
using depth_scenes::cracked;
using depth_scenes::inside_out;
using depth_scenes::messages;
using depth_scenes::prism;
using depth_scenes::sheet;
using depth_scenes::steps;

constexpr Vec3 kUp{0, 0, 1}, kDown{0, 0, -1};

/// Components that end `beyond` under the plane that they start 1 mm above.
AuditReport press(const TriangleMesh& tool, double beyond) {
  return audit_pair(block(), tool, along(kDown, {0, 0.5, 1 + beyond}));
}

TEST(AuditPath, RejectsPointsThatSinkIntoABlockAlongAMeshEdge) {
  for (const TriangleMesh& tool :
       {depth_scenes::pyramid(20, 30, 1), depth_scenes::cone(24, 20, 4, 1), depth_scenes::wedge(2, 60, 30, 1)}) {
    const AuditReport deep = press(tool, 0.4);
    ASSERT_EQ(deep.violations.size(), 1u);
    const AuditViolation& violation = deep.violations[0];
    EXPECT_EQ(violation.frame, 1u);
    EXPECT_LE(violation.greatest, 0.4 + 1e-9);
    EXPECT_GE(violation.greatest, 0.4 / 1.05 - 0.001);
    EXPECT_TRUE(press(tool, 0.005).holds()) << messages(press(tool, 0.005));
    EXPECT_TRUE(press(tool, 0.01).holds());
    EXPECT_FALSE(press(tool, 0.0112).holds());
  }
}

TEST(AuditPath, RejectsABallDeeperThanTheTolerance) {
  const TriangleMesh plate = scenes::box({-20, -20, -5}, {20, 20, 0}),
                     ball = depth_scenes::ball(48, 24, 0.5, {3, 1, 1});
  EXPECT_TRUE(audit_pair(plate, ball, along(kDown, {0, 0.549}), 0.05).holds());
  EXPECT_FALSE(audit_pair(plate, ball, along(kDown, {0, 0.56}), 0.05).holds());
}

TEST(AuditPath, RejectsACubeThatGoesThroughASheetThatLiesOnItEitherWayRound) {
  for (const double z : {0.0, -0.005})
    for (const bool up : {true, false}) {
      const TriangleMesh on = up ? sheet(3, z) : inside_out(sheet(3, z));
      const AuditReport through = audit_pair(on, block(), along(kUp, steps(0.1, 31)));
      EXPECT_EQ(through.sheets, 1u);
      ASSERT_EQ(through.violations.size(), 1u) << z << up;
      EXPECT_GT(through.violations[0].greatest, 2.9);
      EXPECT_TRUE(audit_pair(block(), on, along(kUp, steps(0.1, 31))).holds());
      EXPECT_TRUE(audit_pair(on, block(), along(kUp, {0, 0.003})).holds());
    }
}

TEST(AuditPath, RejectsAPegThroughTheBottomOfItsHoleAlsoWithCracks) {
  const TriangleMesh hole = blind_hole(48, 5, 12, 15, 30), peg = prism(circle(48, 5.02), 20, 45);
  for (const bool crack : {false, true}) {
    const TriangleMesh h = crack ? cracked(hole, 1) : hole, p = crack ? cracked(peg, 1) : peg;
    EXPECT_TRUE(audit_pair(h, p, along(kDown, steps(0.5, 10))).holds());
    const AuditReport through = audit_pair(h, p, along(kDown, steps(2.5, 9)));
    ASSERT_EQ(through.violations.size(), 1u);
    EXPECT_NEAR(through.pairs[0].initial_depth, 0.02, 0.002);
    EXPECT_EQ(through.violations[0].frame, 2u);
    EXPECT_GT(through.violations[0].greatest, 4.7);
  }
}

TEST(AuditPath, LetsCrossingRodsPartAndRejectsThatTheyCrossAgain) {
  const TriangleMesh a = scenes::moved(prism(circle(32, 5), -50, 50), {{}, quat_about({0, 1, 0}, std::acos(0.0))});
  const TriangleMesh b = scenes::moved(prism(circle(32, 5), -50, 50), {{}, quat_about({1, 0, 0}, std::acos(0.0))});
  std::vector<double> way = steps(1, 20);
  EXPECT_TRUE(audit_pair(b, a, along(kUp, way)).holds());
  way.push_back(10.5);
  const AuditReport apart = audit_pair(b, a, along(kUp, way));
  EXPECT_TRUE(apart.holds()) << messages(apart);
  EXPECT_TRUE(apart.pairs[0].parted);
  EXPECT_NEAR(apart.pairs[0].initial_depth, 5, 0.03);
  way.push_back(8);
  const AuditReport again = audit_pair(b, a, along(kUp, way));
  ASSERT_EQ(again.violations.size(), 1u);
  EXPECT_EQ(again.violations[0].frame, 21u);
  EXPECT_EQ(again.violations[0].allowed, 0.01);
  EXPECT_NE(messages(again).find("as they have been apart"), std::string::npos);
}

TEST(AuditPath, LetsOverlappingGearsComeOffAlongTheirAxisOnly) {
  const TriangleMesh large = prism(depth_scenes::gear(24, 22, 26.5, 0), 0, 10);
  const TriangleMesh small =
      scenes::moved(prism(depth_scenes::gear(16, 14, 18.5, std::numbers::pi), 0, 10), {{40, 0, 0}, {}});
  const AuditReport axial = audit_pair(large, small, along(kUp, steps(2, 10)));
  EXPECT_TRUE(axial.holds()) << messages(axial);
  EXPECT_EQ(axial.pairs.size(), 1u);
  EXPECT_FALSE(audit_pair(large, small, along({-1, 0, 0}, steps(0.25, 4))).holds());
}

TEST(AuditPath, LetsAScrewInASmallerHoleOutAlongItsAxisOnly) {
  const TriangleMesh plate = blind_hole(48, 3.3, 12, 2, 20), screw = prism(circle(36, 4), 5, 35);
  const AuditReport axial = audit_pair(plate, screw, along(kUp, steps(2.5, 10)));
  EXPECT_TRUE(axial.holds()) << messages(axial);
  const AuditReport sideways = audit_pair(plate, screw, along({1, 0, 0}, steps(0.1, 100)));
  ASSERT_EQ(sideways.violations.size(), 1u);
  EXPECT_EQ(sideways.violations[0].frame, 0u);
}

TEST(AuditPath, RejectsAnOverlapThatDeepensWithinOneMotion) {
  const TriangleMesh ball = depth_scenes::ball(48, 24, 0.5, {3, 1, 0});
  for (const double way : {0.008, 0.03, 0.2}) {
    EXPECT_EQ(audit_pair(block(), ball, along(kDown, {0, way})).holds(), way < 0.01) << way;
    EXPECT_EQ(audit_pair(ball, block(), along(kUp, {0, way})).holds(), way < 0.01) << way;
  }
  EXPECT_TRUE(audit_pair(block(), ball, along(kUp, {0, 2})).holds());
}

TEST(AuditPath, RejectsAWeightThatPassesThroughAFoilThinnerThanTheTolerance) {
  const TriangleMesh foil = scenes::box({-20, -20, -0.004}, {20, 20, 0}), weight = scenes::box({-3, -3, 1}, {3, 3, 4});
  EXPECT_TRUE(audit_pair(foil, weight, along(kDown, {0, 1.009})).holds());
  EXPECT_FALSE(audit_pair(foil, weight, along(kDown, {0, 1.03})).holds());
  EXPECT_FALSE(audit_pair(foil, weight, along(kDown, {0, 20})).holds());
}

TEST(AuditPath, SeesAThinPartThatIsDeepOnlyBetweenFrames) {
  const TriangleMesh wall = scenes::box({-0.5, -20, -20}, {0.5, 20, 20}),
                     blade = scenes::box({-0.1, -1, -1}, {0.1, 1, 1});
  const TriangleMesh start = scenes::moved(blade, {{-30, 0, 0}, {}});
  EXPECT_FALSE(audit_pair(wall, start, along({1, 0, 0}, {0, 60})).holds());
  EXPECT_TRUE(audit_pair(wall, start, along({1, 0, 0}, {0, 29})).holds());
}

/// A cube turns by 90 degrees about its centre, above a plate: midway its edge reaches sqrt(1/2) below the centre.
AuditReport turn_cube(double overlap, Vec3 far, double climb) {
  const double reach = std::sqrt(0.5);
  Pose end = audit_scenes::turned_about_z(std::acos(0.0), far);
  end.position.z += climb;
  return audit_pair(
      scenes::moved(scenes::box({-10, -11 - reach + overlap, -10}, {10, -reach + overlap, 10}), {far, {}}),
      scenes::moved(scenes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), {far, {}}), {Pose{}, end});
}

TEST(AuditPath, SeesArcsThatDipBetweenFrames) {
  for (const double climb : {0.0, 3.0}) {
    EXPECT_TRUE(turn_cube(0.0095, {}, climb).holds()) << messages(turn_cube(0.0095, {}, climb));
    EXPECT_FALSE(turn_cube(0.0112, {}, climb).holds());
  }
}

TEST(AuditPath, DecidesFarFromTheOriginAsNearIt) {
  for (const Vec3 far : {Vec3{1e5, -2e5, 3e4}, Vec3{-1e6, 0, 0}}) {
    EXPECT_TRUE(turn_cube(0.0095, far, 0).holds()) << messages(turn_cube(0.0095, far, 0));
    EXPECT_FALSE(turn_cube(0.0112, far, 0).holds());
  }
}

TEST(AuditPath, CountsInsideOutAndOpenMeshesAsSolids) {
  const TriangleMesh tool = depth_scenes::pyramid(20, 30, 1);
  for (const TriangleMesh& solid :
       {inside_out(block()), cracked(block(), 3), depth_scenes::without(block(), 0), cracked(inside_out(block()), 2)}) {
    EXPECT_FALSE(audit_pair(solid, tool, along(kDown, {0, 1.4})).holds());
    EXPECT_TRUE(audit_pair(solid, tool, along(kDown, {0, 1.008})).holds());
    EXPECT_FALSE(audit_pair(tool, solid, along(kUp, {0, 1.4})).holds());
  }
}

TEST(AuditPath, SeesAlignedSolidsOfTheSameCrossSectionPushedIntoEachOther) {
  const TriangleMesh lower = scenes::box({0, 0, -2}, {1, 1, 0}), upper = scenes::box({0, 0, 0}, {1, 1, 2});
  EXPECT_TRUE(audit_pair(lower, upper, along(kDown, {0, 0.009})).holds());
  EXPECT_FALSE(audit_pair(lower, upper, along(kDown, {0, 0.02})).holds());
}

TEST(AuditPath, AcceptsLongSlidingContactCheaply) {
  std::vector<Pose> poses;
  for (int k = 0; k <= 20; ++k) poses.push_back({{0.35 * k, 0.1 * k, -0.0003 * k}, quat_about({0, 0, 1}, 0.05 * k)});
  const AuditReport audit = audit_pair(block(), scenes::box({-3, -3, 0}, {3, 3, 3}), poses);
  EXPECT_TRUE(audit.holds()) << messages(audit);
  EXPECT_LT(audit.pieces, 20000u);
}

TEST(AuditPath, ReportsMoveFrameTimePointAndInconsistentFiles) {
  const Assembly a = scenes::assembly(
      {scenes::component("block", block()), scenes::component("pin", scenes::box({1, 2, 1}, {2, 3, 9}))});
  Path path = audit_scenes::path_of(a, 0.01);
  path.moves = {audit_scenes::move_through({"block"}, along(kDown, {0, 1})),
                audit_scenes::move_through({"pin"}, along(kDown, {0, 1, 2, 4}))};
  const AuditReport audit = audit_path(a, path);
  ASSERT_EQ(audit.violations.size(), 1u);
  const AuditViolation& violation = audit.violations[0];
  EXPECT_EQ(violation.move, 1u);
  EXPECT_EQ(violation.frame, 2u);
  EXPECT_GT(violation.time, 0.2);
  EXPECT_LE(violation.time, 0.3);
  EXPECT_LE(violation.point.z, -1);
  EXPECT_GT(violation.point.x, 0.999);
  EXPECT_LT(violation.point.x, 2.001);
  path.moves[1].frames[0].pose.position.x = 1;
  EXPECT_EQ(audit_scenes::count(audit_path(a, path), AuditViolationKind::PathInconsistent), 1u);
}

TEST(AuditPath, CanBeCancelled) {
  const Assembly a = scenes::assembly({scenes::component("a", block()), scenes::component("b", block())});
  const AuditReport audit =
      audit_path(a, audit_scenes::path_of(a, 0.01), {{}, [](std::string_view, double) { return false; }});
  EXPECT_FALSE(audit.complete);
  EXPECT_FALSE(audit.holds());
}

}  // namespace
}  // namespace dismantle
