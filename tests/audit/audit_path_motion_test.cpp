// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"

#include "tests/audit/audit_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

using audit_scenes::messages;
using audit_scenes::move_through;
using audit_scenes::path_of;
using audit_scenes::shifted;
using audit_scenes::turned_about_z;
using scenes::assembly;
using scenes::box;
using scenes::component;
using scenes::tube;

constexpr double kTolerance = 0.01;

/// A unit cube above a plate, `gap` between them:
///      +--+
///      |  |        cube (moves)
///      +--+
///   ==========     plate, its top at z = 0
Assembly cube_over_plate(double gap, double plate_thickness = 1) {
  return assembly({component("plate", box({-10, -10, -plate_thickness}, {10, 10, 0})),
                   component("cube", box({-0.5, -0.5, gap}, {0.5, 0.5, gap + 1}))});
}

AuditReport audit(const Assembly& a, std::vector<Move> moves) {
  Path path = path_of(a, kTolerance);
  path.moves = std::move(moves);
  return audit_path(a, path);
}

TEST(AuditPathMotion, HoldsForAnEmptyPathOfAnAssemblyWithoutOverlaps) {
  const AuditReport report = audit(cube_over_plate(0), {});
  EXPECT_TRUE(report.holds()) << messages(report);
  EXPECT_TRUE(audit_path(Assembly{}, Path{}).holds());
}

TEST(AuditPathMotion, FindsTunnellingThroughAThinPlateInOneFrame) {
  const Assembly a = cube_over_plate(5, 0.001);
  const AuditReport report = audit(a, {move_through({"cube"}, {shifted(0, 0, 0), shifted(0, 0, -20)})});
  EXPECT_EQ(report.violations.size(), 1u) << messages(report);
}

TEST(AuditPathMotion, FindsTunnellingThroughASheetInOneFrame) {
  TriangleMesh sheet;
  sheet.vertices = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}};
  sheet.faces = {{{0, 1, 2}}, {{0, 2, 3}}};
  const Assembly a = assembly({component("sheet", sheet), component("cube", box({0, 0, 5}, {1, 1, 6}))});
  EXPECT_TRUE(audit(a, {move_through({"cube"}, {shifted(0, 0, 0), shifted(0, 0, -4.9)})}).holds());
  EXPECT_FALSE(audit(a, {move_through({"cube"}, {shifted(0, 0, 0), shifted(0, 0, -20)})}).holds());
}

/// A cube turns by 90 degrees about its centre, above a plate: midway its edge reaches sqrt(1/2) below the centre.
AuditReport audit_turning_cube(double overlap) {
  const double reach = std::sqrt(0.5);
  const Assembly a = assembly({component("plate", box({-10, -11 - reach + overlap, -10}, {10, -reach + overlap, 10})),
                               component("cube", box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}))});
  return audit(a, {move_through({"cube"}, {Pose{}, turned_about_z(std::acos(0.0), {})})});
}

TEST(AuditPathMotion, FindsAMidFrameGrazeThatIsClearAtBothFrames) {
  const AuditReport report = audit_turning_cube(1.5 * kTolerance);
  ASSERT_EQ(report.violations.size(), 1u) << messages(report);
  EXPECT_LE(report.violations[0].depth, 1.5 * kTolerance + 1e-9);
}

TEST(AuditPathMotion, AcceptsAGrazeWithinTheTolerance) {
  const AuditReport report = audit_turning_cube(0.9 * kTolerance);
  EXPECT_TRUE(report.holds()) << messages(report);
  EXPECT_FALSE(audit_turning_cube(1.12 * kTolerance).holds());
}

TEST(AuditPathMotion, AcceptsRestingWithinTheToleranceAndRefusesDeeper) {
  const Assembly a = cube_over_plate(0);
  EXPECT_TRUE(audit(a, {move_through({"cube"}, {shifted(0, 0, 0), shifted(3, 0, -0.9 * kTolerance)})}).holds());
  EXPECT_FALSE(audit(a, {move_through({"cube"}, {shifted(0, 0, 0), shifted(3, 0, -1.1 * kTolerance)})}).holds());
}

/// A pin of 24 sides in a hole of 24 sides, `clearance` between them; negative for a press fit.
Assembly pin_in_hole(double clearance) {
  return assembly({component("housing", tube(10, 5, 0, 10, 24)), component("pin", tube(5 - clearance, 0, 1, 12, 24))});
}

TEST(AuditPathMotion, AcceptsAPinThatLeavesItsHoleWithTinyClearance) {
  std::vector<Pose> poses;
  for (int k = 0; k <= 30; ++k) poses.push_back(shifted(0, 0, 0.5 * k));
  const AuditReport report = audit(pin_in_hole(0.001), {move_through({"pin"}, poses)});
  EXPECT_TRUE(report.holds()) << messages(report);
}

TEST(AuditPathMotion, FindsAPinThatLeavesThroughTheWall) {
  std::vector<Pose> poses;
  for (int k = 0; k <= 30; ++k) poses.push_back(shifted(0.7 * k, 0, 0));
  const AuditReport report = audit(pin_in_hole(0.001), {move_through({"pin"}, poses)});
  EXPECT_FALSE(report.holds());
}

TEST(AuditPathMotion, FindsATinyComponentThatEndsUpInsideAnother) {
  const double size = 0.5 * kTolerance;
  const Assembly a = assembly(
      {component("block", box({-5, -5, -5}, {5, 5, 5})), component("grain", box({0, 0, 6}, {size, size, 6 + size}))});
  const std::vector<Pose> in = {Pose{}, shifted(0, 0, -0.6), shifted(0, 0, -1.5), shifted(0, 0, -3)};
  const AuditReport report = audit(a, {move_through({"grain"}, in)});
  EXPECT_EQ(report.violations.size(), 1u) << messages(report);
  const AuditReport mirrored = audit(a, {move_through({"block"}, {Pose{}, shifted(0, 0, 0.6), shifted(0, 0, 3)})});
  EXPECT_EQ(mirrored.violations.size(), 1u) << messages(mirrored);
}

TEST(AuditPathMotion, FindsATinyComponentThatPassesThroughInOneFrame) {
  const double size = 0.5 * kTolerance;
  const Assembly a = assembly(
      {component("block", box({-5, -5, -5}, {5, 5, 5})), component("grain", box({0, 0, 6}, {size, size, 6 + size}))});
  const AuditReport report = audit(a, {move_through({"grain"}, {Pose{}, shifted(0, 0, -20)})});
  EXPECT_EQ(report.violations.size(), 1u) << messages(report);
}

/// In one frame it passes a plate of less than two tolerances, and then perhaps enters a block.
TEST(AuditPathMotion, FindsATinyComponentThatPassesAThinPlate) {
  const double size = 0.5 * kTolerance;
  TriangleMesh both = box({-5, -5, 0}, {5, 5, 1.5 * kTolerance});
  const TriangleMesh block = box({-5, -5, -9}, {5, 5, -4});
  const auto first = static_cast<std::uint32_t>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), block.vertices.begin(), block.vertices.end());
  for (const Face& f : block.faces) both.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
  const Assembly a = assembly(
      {component("plate and block", both), component("grain", box({0.1, 0.2, 1}, {0.1 + size, 0.2 + size, 1 + size}))});
  EXPECT_TRUE(audit(a, {move_through({"grain"}, {Pose{}, shifted(0, 0, -0.99)})}).holds());
  EXPECT_FALSE(audit(a, {move_through({"grain"}, {Pose{}, shifted(0, 0, -3)})}).holds());
  const AuditReport report = audit(a, {move_through({"grain"}, {Pose{}, shifted(0, 0, -7)})});
  EXPECT_EQ(report.violations.size(), 1u) << messages(report);
}

/// A grain of `size`, below the tolerance, with its bottom `height` above a large block.
Assembly grain_over_block(double size, double height) {
  return assembly({component("block", box({-50, -50, -50}, {50, 50, 0})),
                   component("grain", box({0.1, 0.2, height}, {0.1 + size, 0.2 + size, height + size}))});
}

TEST(AuditPathMotion, FollowsAVertexInsideFromMoveToMove) {
  const double size = 0.5 * kTolerance;
  const Assembly a = grain_over_block(size, 1);
  const Pose below = shifted(0, 0, -1 - 1.2 * size);
  const Move in = move_through({"grain"}, {Pose{}, below});
  EXPECT_TRUE(audit(a, {in}).holds());
  const Move deeper = move_through({"grain"}, {below, below * shifted(0, 0, -0.1)});
  const Move back = move_through({"grain"}, {below, below * shifted(0, 0, 2)});
  EXPECT_TRUE(audit(a, {in, back}).holds());
  const AuditReport report = audit(a, {in, deeper});
  ASSERT_EQ(report.violations.size(), 1u) << messages(report);
  EXPECT_EQ(report.violations[0].move, 1u);
  const Move block_up = move_through({"block"}, {Pose{}, shifted(0, 0, 0.1)});
  EXPECT_EQ(audit(a, {in, block_up}).violations.size(), 1u);
}

Pose turned_about_y(double angle, Vec3 point) {
  const Quat q = quat_about({0, 1, 0}, angle);
  return {point - mat3_from_quat(q) * point, q};
}

/// The ends of the arc are on the surface, its middle below:  ---.       .---
///                                                               `-----'
TEST(AuditPathMotion, FollowsAVertexOnItsArcNotOnTheChord) {
  const double radius = 10;
  const auto run = [&](double sagitta) {
    const double half = std::acos(1 - sagitta / radius);
    const Assembly a = grain_over_block(0.5 * kTolerance, -0.4 * kTolerance);
    const Vec3 axis{0.1 + radius * std::sin(half), 0, radius * std::cos(half)};
    return audit(a, {move_through({"grain"}, {Pose{}, turned_about_y(-2 * half, axis)})});
  };
  EXPECT_TRUE(run(0.5 * kTolerance).holds());
  EXPECT_EQ(run(0.8 * kTolerance).violations.size(), 1u) << messages(run(0.8 * kTolerance));
}

/// It starts parallel to the surface and curves through it: only the acceleration reveals the crossing.
TEST(AuditPathMotion, FindsACrossingCausedOnlyByTheCurvatureOfThePath) {
  const double size = 0.2 * kTolerance, radius = 10;
  const Assembly a = grain_over_block(size, 0.1 * kTolerance);
  const double angle = std::acos(1 - 0.5 * kTolerance / radius);
  const Pose below = turned_about_y(angle, {0.1 + size / 2, 0, -radius});
  const Pose deep = shifted(0, 0, -1) * below;
  EXPECT_TRUE(audit(a, {move_through({"grain"}, {Pose{}, below})}).holds());
  const AuditReport report = audit(a, {move_through({"grain"}, {Pose{}, below, deep})});
  EXPECT_EQ(report.violations.size(), 1u) << messages(report);
}

/// A finely tessellated rod makes more than half a turn in a few frames; it meets a pin between two frames.
TEST(AuditPathMotion, FindsAPinThatASwingingRodPassesInMidFrame) {
  const Vec3 pin{9 * std::cos(0.4), 9 * std::sin(0.4), 0};
  const Assembly a = assembly(
      {component("pin", box(pin - Vec3{0.2, 0.2, 5}, pin + Vec3{0.2, 0.2, 5})),
       component("rod", scenes::moved(tube(0.3, 0, -10, 10, 8, 60), {{}, quat_about({0, 1, 0}, std::acos(0.0))}))});
  const auto swing = [&](int first, int last) {
    std::vector<Pose> poses;
    for (int k = first; k <= last; ++k) poses.push_back(turned_about_z(0.8 * k, {}));
    return poses;
  };
  EXPECT_FALSE(audit(a, {move_through({"rod"}, swing(0, 5))}).holds());
  EXPECT_FALSE(audit(a, {move_through({"rod"}, swing(0, 1))}).holds());
  Pose lifted = shifted(0, 0, 6);
  std::vector<Pose> over;
  for (const Pose& pose : swing(0, 5)) over.push_back(lifted * pose);
  EXPECT_TRUE(audit(a, {move_through({"rod"}, {Pose{}, lifted}), move_through({"rod"}, over)}).holds());
}

TEST(AuditPathMotion, AcceptsAComponentInTheCavityOfAnother) {
  TriangleMesh shell = box({-5, -5, -5}, {5, 5, 5});
  TriangleMesh cavity = box({-3, -3, -3}, {3, 3, 3});
  for (Face face : cavity.faces) {
    std::swap(face.v[1], face.v[2]);
    for (std::uint32_t& v : face.v) v += 8;
    shell.faces.push_back(face);
  }
  shell.vertices.insert(shell.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
  const Assembly a = assembly({component("shell", shell), component("ball", box({-1, -1, -1}, {1, 1, 1}))});
  const AuditReport report = audit(a, {move_through({"ball"}, {Pose{}, shifted(2, 2, 2), shifted(-2, 0, 1)})});
  EXPECT_TRUE(report.holds()) << messages(report);
  EXPECT_FALSE(audit(a, {move_through({"ball"}, {Pose{}, shifted(2.2, 0, 0)})}).holds());
}

TEST(AuditPathMotion, ChecksOnlyPairsOfWhichOneMoves) {
  const Assembly a =
      assembly({component("plate", box({-10, -10, -1}, {10, 10, 0})), component("left", box({-3, 0, 0}, {-2, 1, 1})),
                component("right", box({2, 0.5, 0}, {3, 1.5, 1}))});
  const Move both = move_through({"left", "right"}, {Pose{}, shifted(5, 0, 0)});
  EXPECT_TRUE(audit(a, {both}).holds());
  const Move left = move_through({"left"}, {Pose{}, shifted(5, 0, 0)});
  const AuditReport report = audit(a, {left});
  ASSERT_FALSE(report.violations.empty());
  for (const AuditViolation& violation : report.violations) {
    EXPECT_EQ(violation.a, ComponentId(1));
    EXPECT_EQ(violation.b, ComponentId(2));
  }
}

TEST(AuditPathMotion, ContinuesFromTheEndOfThePrecedingMoves) {
  const Assembly a = cube_over_plate(5);
  const Move sideways = move_through({"cube"}, {Pose{}, shifted(20, 0, 0)});
  const Move down = move_through({"cube"}, {shifted(20, 0, 0), shifted(20, 0, -8)});
  EXPECT_TRUE(audit(a, {sideways, down}).holds());
  const Move plate_up = move_through({"plate"}, {Pose{}, shifted(20, 0, 0), shifted(20, 0, 6)});
  EXPECT_FALSE(audit(a, {sideways, plate_up}).holds());
}

TEST(AuditPathMotion, IsNotCompleteWhenCancelled) {
  const Assembly a = cube_over_plate(0);
  Path path = path_of(a, kTolerance);
  path.moves = {move_through({"cube"}, {Pose{}, shifted(1, 0, 0)})};
  int calls = 0;
  AuditOptions options;
  options.progress = [&calls](std::string_view, double) { return ++calls < 3; };
  const AuditReport report = audit_path(a, path, options);
  EXPECT_FALSE(report.complete);
  EXPECT_FALSE(report.holds());
  double last = -1;
  options.progress = [&last](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  };
  EXPECT_TRUE(audit_path(a, path, options).holds());
  EXPECT_EQ(last, 1);
}

TEST(AuditPathMotion, WorksFarFromTheOriginAndAtAllScales) {
  for (const double scale : {1e-2, 1.0, 1e2}) {
    const Vec3 far{1e4, -2e4, 1.5e4};
    const auto scaled_box = [&](Vec3 lower, Vec3 upper) { return box(far + scale * lower, far + scale * upper); };
    const Assembly a = assembly({component("plate", scaled_box({-10, -10, -1}, {10, 10, 0})),
                                 component("cube", scaled_box({-0.5, -0.5, 0}, {0.5, 0.5, 1}))});
    const double tolerance = 1e-3 * scale;
    const auto holds = [&](double dip) {
      Path path = path_of(a, tolerance);
      // Turns about the cube's vertical axis and dips by `dip` tolerances meanwhile.
      const Quat q = quat_about({0, 0, 1}, 1);
      const Vec3 across = far - mat3_from_quat(q) * far;
      path.moves = {move_through({"cube"}, {Pose{}, {across - Vec3{0, 0, dip * tolerance}, q}})};
      return audit_path(a, path).holds();
    };
    EXPECT_TRUE(holds(0.9)) << scale;
    EXPECT_FALSE(holds(1.1)) << scale;
  }
}

}  // namespace
}  // namespace dismantle
