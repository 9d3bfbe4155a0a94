// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/certificate_engine.h"

#include "tests/certificates/grabbed_component.h"
#include "tests/support/executors.h"
#include "tests/support/large_scenes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/slide_scenes.h"
#include "tests/support/swept_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

using namespace grabbed;
using scenes::box;
using scenes::component;
using scenes::tube;

TEST(CertificateEngine, StopsIfTheWholeStepIsNotFree) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  const StepResult r = h.engine.step({{0, 0, -3}, {}}, ResponseKind::Stop);
  EXPECT_EQ(r.pose, Pose{});
  EXPECT_FALSE(r.blocking_pairs.empty());
}

TEST(CertificateEngine, TouchesWithinTheTolerance) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  const StepResult r = h.engine.step({{0, 0, -3}, {}}, ResponseKind::Touch);
  EXPECT_NEAR(r.pose.position.z, -1, kTolerance);
  EXPECT_EQ(r.pose.position.x, 0);
}

TEST(CertificateEngine, SlidesAlongTheFloorAndNamesItsContacts) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  StepResult r;
  for (int step = 1; step <= 10; ++step) r = h.engine.step({{1.0 * step, 0, -3}, {}}, ResponseKind::Slide);
  EXPECT_NEAR(r.pose.position.x, 10, 0.05);
  EXPECT_NEAR(r.pose.position.z, -1, kTolerance);
  EXPECT_FALSE(r.reached);
  ASSERT_FALSE(r.contact_points.empty());
  for (const ContactPoint& c : r.contact_points) {
    EXPECT_EQ(c.moving, ComponentId(0));
    EXPECT_EQ(c.fixed, ComponentId(1));
    EXPECT_NEAR(c.normal.z, 1, 1e-6);
    EXPECT_LE(std::abs(c.gap), kTolerance);
    EXPECT_NEAR(c.point.z, 0, kTolerance);
  }
}

/// A shaft in a bush, both finely meshed; either the smaller or the larger one moves.
Assembly shaft_in_bush(double clearance) {
  return scenes::assembly({component("shaft", tube(5 - clearance, 0, -20, 20, 128, 2)),
                           component("bush", scenes::extruded_band(scenes::square_around(12, 128),
                                                                   scenes::circle(5, 128), true, -10, 10, 2))});
}

TEST(CertificateEngine, SlidesAWholeCylinderAlongItsBoreAsOne) {
  const Assembly assembly = shaft_in_bush(0.005);
  const PairStates states = states_of(assembly);
  for (const std::uint32_t moving : {0u, 1u}) {
    Grabbed h(assembly, states, moving);
    std::mt19937_64 random(8);
    std::size_t looked_at = 0;
    for (int step = 1; step <= 30; ++step) {
      const Vec3 press = 0.2 * normalized(scenes::random_vector(random, 1));
      const StepResult r =
          h.engine.step({{press.x, press.y, 0.2 * step}, quat_about({0, 0, 1}, 0.03 * step)}, ResponseKind::Slide);
      EXPECT_NEAR(r.pose.position.z, 0.2 * step, 0.02) << step;
      EXPECT_LT(std::hypot(r.pose.position.x, r.pose.position.y), 0.005 + kTolerance) << step;
      if (step <= 4) continue;  // the cylinder is found from its triangles first
      looked_at += r.cost.tests;
      ASSERT_FALSE(r.blocking_pairs.empty());
      ASSERT_FALSE(r.contact_points.empty());
      for (const ContactPoint& c : r.contact_points) {
        EXPECT_EQ(c.moving, ComponentId(moving));
        EXPECT_NEAR(std::hypot(c.point.x, c.point.y), 5, 3 * kTolerance);
        const double outwards = (c.point.x * c.normal.x + c.point.y * c.normal.y) / 5;
        EXPECT_NEAR(outwards, moving == 0 ? -1 : 1, 0.01);
        EXPECT_LT(std::abs(c.gap), kTolerance);
        const Triangle own = assembly[c.moving].mesh->triangle(c.face_moving.value);
        EXPECT_LT(std::abs(normalized(normal_unscaled(own)).z), 0.01) << "the cylinder is in contact";
      }
    }
    EXPECT_LT(looked_at, 26 * 8u) << "apart from the rims";
  }
}

TEST(CertificateEngine, ReachesPosesThatTrianglesAllowAndTheirCylindersDoNot) {
  // Corners of the shaft in corners of the bore: there is less room up to the bore's flats.
  const Assembly assembly = shaft_in_bush(0.004);
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  h.engine.step({{0.2, 0, 0}, {}}, ResponseKind::Slide);
  int allowed = 0;
  for (double off = 0.006; off < 0.016; off += 0.0005) {
    const Pose target{{off, 0, 0}, {}};
    Grabbed fresh(assembly, states, 0);
    if (!fresh.engine.step(target, ResponseKind::Stop).reached) continue;
    ++allowed;
    EXPECT_TRUE(h.engine.step(target, ResponseKind::Slide).reached) << off;
  }
  EXPECT_GT(allowed, 5);
}

TEST(CertificateEngine, LeavesABoreThatIsOpenToOneSide) {
  // A ring, and on it half a ring that continues its bore.
  const std::uint32_t sides = 96;
  TriangleMesh seat = scenes::extruded_band(scenes::circle(9, sides), scenes::circle(5, sides), true, 0, 10);
  scenes::Profile outer = scenes::circle(9, sides), inner = scenes::circle(5, sides);
  outer.resize(sides / 2 + 1);
  inner.resize(sides / 2 + 1);
  const TriangleMesh half = scenes::extruded_band(outer, inner, false, 10, 20);
  const auto first = static_cast<std::uint32_t>(seat.vertices.size());
  seat.vertices.insert(seat.vertices.end(), half.vertices.begin(), half.vertices.end());
  for (const Face& f : half.faces) seat.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
  const Assembly assembly =
      scenes::assembly({component("shaft", tube(4.99, 0, 0, 30, sides)), component("seat", std::move(seat))});
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  for (int step = 1; step <= 22; ++step)
    h.engine.step({{0.1 * (step % 3), 0.1 * (step % 2), 0.5 * step}, {}}, ResponseKind::Slide);
  ASSERT_GT(h.engine.poses()[0].position.z, 10.5) << "out of the ring";
  StepResult r;
  for (int step = 1; step <= 20; ++step) r = h.engine.step({{0.2, -1.0 * step, 11}, {}}, ResponseKind::Slide);
  EXPECT_LT(r.pose.position.y, -19);
}

TEST(CertificateEngine, StaysAtRestWithoutMotion) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  const Pose target{{3, 1, -4}, quat_about({1, 0, 0}, 0.05)};
  for (int step = 0; step < 50; ++step) h.engine.step(target, ResponseKind::Slide);
  const Pose resting = h.engine.poses()[0];
  for (int step = 0; step < 10; ++step) {
    const StepResult r = h.engine.step(target, ResponseKind::Slide);
    EXPECT_EQ(r.pose, resting);
    EXPECT_TRUE(r.poses.empty());
  }
}

TEST(CertificateEngine, LeavesAContact) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  h.engine.step({{0, 0, -3}, {}}, ResponseKind::Slide);
  const Pose up{{0, 2, 5}, quat_about({0, 1, 0}, 0.3)};
  EXPECT_TRUE(h.engine.step(up, ResponseKind::Slide).reached);
  EXPECT_EQ(h.engine.poses()[0], up);
}

TEST(CertificateEngine, TakesARotationForTheSameWithAllItsSignsChanged) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  const Pose up{{0, 2, 5}, quat_about({0, 1, 0}, 0.3)}, other{{1, 2, 5}, quat_about({0, 1, 0}, 0.4)};
  const Pose same{up.position, -up.rotation}, other_same{other.position, -other.rotation};
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}) {
    Grabbed h(assembly, states, 0);
    ASSERT_TRUE(h.engine.step(up, response).reached);
    const StepResult stay = h.engine.step(same, response);
    EXPECT_TRUE(stay.reached);
    EXPECT_TRUE(stay.poses.empty());
    EXPECT_EQ(h.engine.poses()[0], up);
    EXPECT_TRUE(h.engine.step(other_same, response).reached);
    EXPECT_EQ(h.engine.poses()[0], other);
  }
}

TEST(CertificateEngine, GivesTheSameOnEveryExecutorAndLaneCount) {
  std::mt19937_64 seed(11);
  const Assembly assembly = scenes::random_assembly(seed, 12, 6);
  const PairStates states = states_of(assembly);
  const auto play = [&](const CertificateOptions& options) {
    std::mt19937_64 random(12);
    std::vector<Pose> poses;
    CertificateEngine engine(assembly, states, options);
    for (std::uint32_t c = 0; c < 2; ++c) {
      const ComponentId id(c);
      engine.grab({&id, 1});
      for (int step = 0; step < 3; ++step)
        poses.push_back(engine.step(scenes::random_pose(random, 4, 1), ResponseKind::Slide).pose);
    }
    return poses;
  };
  const std::vector<Pose> first = play({});
  // Each executor and each lane count at least once, in pairs. A result that depends on either differs from the first.
  const std::vector<Executor> executors = all_executors();
  const Span<const LaneCount> lanes = lane_counts();
  for (std::size_t i = 0; i < std::max(executors.size(), lanes.size()); ++i) {
    EXPECT_EQ(play({executors[i % executors.size()], lanes[i % lanes.size()]}), first) << i;
  }
}

TEST(CertificateEngine, StopsARotationAltogetherIfItsEndIsBlocked) {
  // A turn of 1.2 rad that meets the post after about 0.5 rad, in many parts.
  const Assembly assembly = scenes::assembly(
      {component("blade", box({0, -0.5, 0}, {30, 0.5, 1})), component("post", box({20, 11, -5}, {21, 12, 5}))});
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  const StepResult r = h.engine.step({{}, quat_about({0, 0, 1}, 1.2)}, ResponseKind::Stop);
  EXPECT_FALSE(r.reached);
  EXPECT_EQ(r.pose, Pose{});
  EXPECT_TRUE(r.poses.empty());
  EXPECT_FALSE(r.blocking_pairs.empty());
  EXPECT_EQ(h.engine.poses()[0], Pose{});
  EXPECT_TRUE(h.engine.step({{}, quat_about({0, 0, 1}, 0.3)}, ResponseKind::Stop).reached);
}

TEST(CertificateEngine, StopPutsAPairThatPartedOnTheWayTogetherAgain) {
  // The rod comes out of the block and meets the ceiling in one rotation about a far axis.
  const Assembly assembly = scenes::assembly({component("rod", box({4, 4, 5}, {8, 8, 20})),
                                              component("block", box({-10, -10, -10}, {10, 10, 10})),
                                              component("ceiling", box({-40, -40, 60}, {40, 40, 61}))});
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  const Vec3 axis_point{-200, 6, 12};
  const Quat turn = quat_about({0, -1, 0}, 0.3);
  const Pose target{axis_point - mat3_from_quat(turn) * axis_point, turn};
  EXPECT_FALSE(h.engine.step(target, ResponseKind::Stop).reached);
  EXPECT_EQ(h.engine.poses()[0], Pose{});
  EXPECT_EQ(h.engine.overlapping_pairs().size(), 1u);
  EXPECT_TRUE(h.engine.step({{0, 0, 10}, {}}, ResponseKind::Stop).reached);
  EXPECT_TRUE(h.engine.overlapping_pairs().empty());
}

TEST(CertificateEngine, KeepsABodyWhereItIsPressedAlthoughItIsTilted) {
  // The pose is tilted by a contact; a screw to a target far below would begin sideways.
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  h.engine.step({{0, 0, 0.5}, quat_about({0, 1, 0}, 0.02)}, ResponseKind::Slide);
  const Vec3 center{5, 5, 6};
  const auto center_now = [&] { return transform_from_pose(h.engine.poses()[0]) * center; };
  for (int k = 1; k <= 60; ++k)
    h.engine.step({Vec3{0, 0, -0.5 * k} + center - mat3_from_quat(quat_about({0, 1, 0}, 0.4)) * center,
                   quat_about({0, 1, 0}, 0.4)},
                  ResponseKind::Slide);
  EXPECT_NEAR(center_now().x, 5, 0.5);
  EXPECT_NEAR(center_now().y, 5, 0.5);
}

TEST(CertificateEngine, ReportsALowerBoundOfTheClearanceWithEachStep) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  const StepResult r = h.engine.step({{1, 2, 3}, quat_about({0, 0, 1}, 0.2)}, ResponseKind::Slide);
  ASSERT_TRUE(r.reached);
  EXPECT_GT(r.clearance, 0.5);
  EXPECT_LE(r.clearance, h.engine.clearance().distance);
}

TEST(CertificateEngine, AllowsAnOverlappingPairItsDepthUntilItIsApart) {
  const Assembly assembly = scenes::assembly(
      {component("rod", box({4, 4, 0}, {8, 8, 20})), component("block", box({-10, -10, -10}, {10, 10, 10}))});
  ClassifyOptions classify;
  classify.tolerance = kTolerance;
  const PairStates states = *classify_pairs(assembly, classify);
  Grabbed h(assembly, states, 0);
  ASSERT_EQ(h.engine.overlapping_pairs().size(), 1u);
  // Its corner is 6 mm deep, and would get deeper.
  EXPECT_EQ(h.engine.step({{-1, -1, 0}, {}}, ResponseKind::Stop).pose, Pose{});
  for (int step = 1; step <= 30; ++step) h.engine.step({{0, 0, 0.5 * step}, {}}, ResponseKind::Slide);
  EXPECT_TRUE(h.engine.overlapping_pairs().empty());
  EXPECT_NEAR(h.engine.poses()[0].position.z, 15, 1e-12);
  // It cannot return now.
  const StepResult back = h.engine.step({{0, 0, 5}, {}}, ResponseKind::Slide);
  EXPECT_NEAR(back.pose.position.z, 10, kTolerance);
}

TEST(CertificateEngine, KeepsOpenSheetsApart) {
  // Two parallel sheets without thickness, pressed together in small steps from either side.
  const TriangleMesh low{{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, {{{0, 1, 2}}}};
  const TriangleMesh high{{{-3, -3, 1}, {3, -3, 1}, {0, 3, 1}}, {{{0, 1, 2}}}};
  const Assembly assembly = scenes::assembly({component("high", high), component("low", low)});
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  for (int step = 0; step < 400; ++step) h.engine.step({{0, 0, -0.005 * step}, {}}, ResponseKind::Slide);
  EXPECT_GE(h.engine.poses()[0].position.z, -1 - kTolerance);
  const ComponentId other(1);
  h.engine.grab({&other, 1});
  for (int step = 0; step < 200; ++step) h.engine.step({{0, 0, 0.005 * step}, {}}, ResponseKind::Slide);
  EXPECT_LE(h.engine.poses()[1].position.z - h.engine.poses()[0].position.z, 1 + 2 * kTolerance);
}

TEST(CertificateEngine, KnowsTheSidesOfOpenSheetsThatAreNearerThanTheTolerance) {
  const TriangleMesh low{{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, {{{0, 1, 2}}}};
  for (const double gap : {0.9 * kTolerance, 0.3 * kTolerance, 0.0}) {
    // Face to face: the upper one faces down.
    const TriangleMesh high{{{-3, -3, gap}, {3, -3, gap}, {0, 3, gap}}, {{{0, 2, 1}}}};
    const Assembly assembly = scenes::assembly({component("high", high), component("low", low)});
    const PairStates states = states_of(assembly);
    Grabbed down(assembly, states, 0), up(assembly, states, 0);
    for (int step = 1; step <= 40; ++step) {
      down.engine.step({{0, 0, -0.005 * step}, {}}, ResponseKind::Slide);
      up.engine.step({{0.1 * step, 0, 0.0005 * step}, {}}, ResponseKind::Slide);
    }
    // Sheets in one plane come apart to either side.
    const double lowest = gap > 0 ? -gap - kTolerance : -0.2;
    EXPECT_GE(down.engine.poses()[0].position.z, lowest) << "gap " << gap;
    EXPECT_NEAR(up.engine.poses()[0].position.z, 0.02, 1e-12) << "gap " << gap;
  }
}

TEST(CertificateEngine, DoesNotDependOnTheOrientationOfTheAssembly) {
  const Pose turn{{30, -20, 10}, quat_about(normalized(Vec3{1, 2, 3}), 1.1)};
  Assembly turned = block_and_floor();
  for (Component& c : turned.components) c.assembly_from_mesh = transform_from_pose(turn) * c.assembly_from_mesh;
  const Assembly straight = block_and_floor();
  const PairStates states = states_of(straight), turned_states = states_of(turned);
  Grabbed a(straight, states, 0), b(turned, turned_states, 0);
  for (int step = 1; step <= 8; ++step) {
    const Pose target{{0.5 * step, 0.2, -0.5 * step}, quat_about({0, 0, 1}, 0.01 * step)};
    const Pose by_a = a.engine.step(target, ResponseKind::Slide).pose;
    const Pose by_b = b.engine.step(turn * target * inverse(turn), ResponseKind::Slide).pose;
    const Pose back = inverse(turn) * by_b * turn;
    EXPECT_NEAR(length(back.position - by_a.position), 0, 0.05) << "step " << step;
  }
}

}  // namespace
}  // namespace dismantle
