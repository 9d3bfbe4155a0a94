// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/certificate_engine.h"

#include "dismantle/engine/classify_pairs.h"
#include "dismantle/math/screw.h"
#include "dismantle/surface/surface_queries.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"
#include "tests/support/slide_scenes.h"
#include "tests/support/swept_meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace dismantle {
namespace {

using scenes::box;
using scenes::component;
using scenes::tube;

constexpr double kTolerance = 0.01;

PairStates states_of(const Assembly& assembly) {
  ClassifyOptions classify;
  classify.tolerance = kTolerance;
  return *classify_pairs(assembly, classify);
}

/// An engine with one moving component.
struct Grabbed {
  Grabbed(const Assembly& assembly, const PairStates& states, std::uint32_t component,
          const CertificateOptions& options = {})
      : engine(assembly, states, options) {
    const ComponentId id(component);
    engine.grab({&id, 1});
  }
  CertificateEngine engine;
};

Assembly block_and_floor() {
  return scenes::assembly(
      {component("block", box({0, 0, 1}, {10, 10, 11})), component("floor", box({-50, -50, -5}, {50, 50, 0}))});
}

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

TEST(CertificateEngine, GivesTheSameOnEveryExecutorAndLaneCount) {
  std::mt19937_64 seed(11);
  const Assembly assembly = scenes::random_assembly(seed, 12, 6);
  const PairStates states = states_of(assembly);
  const auto play = [&](const CertificateOptions& options) {
    std::mt19937_64 random(12);
    std::vector<Pose> poses;
    CertificateEngine engine(assembly, states, options);
    for (std::uint32_t c = 0; c < 4; ++c) {
      const ComponentId id(c);
      engine.grab({&id, 1});
      for (int step = 0; step < 12; ++step)
        poses.push_back(engine.step(scenes::random_pose(random, 4, 1), ResponseKind::Slide).pose);
    }
    return poses;
  };
  const std::vector<Pose> first = play({});
  for (const Executor& executor : all_executors()) EXPECT_EQ(play({executor, widest_lanes()}), first);
  for (const LaneCount lanes : lane_counts()) EXPECT_EQ(play({Executor(), lanes}), first);
}

TEST(CertificateEngine, AnyFrontGivesTheSameFirstContact) {
  std::mt19937_64 random(21);
  const Assembly assembly = scenes::random_assembly(random, 14, 5);
  const PairStates states = states_of(assembly);
  Grabbed used(assembly, states, 0);
  for (int step = 0; step < 60; ++step) {
    const Pose target = scenes::random_pose(random, 6, 0.5);
    Grabbed fresh(assembly, states, 0);
    fresh.engine.jump(used.engine.poses());
    const ComponentId id(0);
    fresh.engine.grab({&id, 1});
    const Pose by_used = used.engine.step(target, ResponseKind::Touch).pose;
    const Pose by_fresh = fresh.engine.step(target, ResponseKind::Touch).pose;
    EXPECT_NEAR(length(by_used.position - by_fresh.position), 0, kTolerance) << "step " << step;
  }
}

TEST(CertificateEngine, MeasuresTheClearanceExactly) {
  std::mt19937_64 random(31);
  const Assembly assembly = scenes::random_assembly(random, 8, 8);
  const PairStates states = states_of(assembly);
  for (std::uint32_t c = 0; c < 8; ++c) {
    Grabbed h(assembly, states, c);
    const AssemblySurface surface = make_assembly_surface(assembly, Executor());
    double minimum = 1e9;
    for (std::uint32_t k = 0; k < 8; ++k)
      if (k != c && !(states.find(ComponentId(c), ComponentId(k)) &&
                      states.find(ComponentId(c), ComponentId(k))->state == PairState::Embedded))
        minimum = std::min(minimum, surface_distance(surface, ComponentId(c), ComponentId(k), 1e9));
    const Clearance clearance = h.engine.clearance();
    EXPECT_NEAR(clearance.distance, minimum, 1e-9);
    EXPECT_NEAR(length(clearance.point_moving - clearance.point_fixed), clearance.distance, 1e-9);
    EXPECT_FALSE(h.engine.clearance(clearance.distance).fixed.valid()) << "nothing is nearer";
    EXPECT_EQ(h.engine.clearance(clearance.distance + 0.1).fixed, clearance.fixed);
  }
}

TEST(CertificateEngine, NamesTheFirstOfEquallyNearComponents) {
  // The box around the wedge is nearer than the posts, the wedge is not.
  const Assembly assembly = scenes::assembly(
      {component("block", box({-1, -1, -1}, {1, 1, 1})), component("post", box({-9, -1, -1}, {-4, 1, 1})),
       component("wedge", scenes::moved(box({-4, -4, -1}, {4, 4, 1}), {{0, 9.8, 0}, quat_about({0, 0, 1}, 0.8)})),
       component("other post", box({4, -1, -1}, {9, 1, 1}))});
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  EXPECT_EQ(h.engine.clearance().distance, 3);
  EXPECT_EQ(h.engine.clearance().fixed, ComponentId(1));
  const Pose aside{{0, 0, 1}, {}};
  h.engine.jump(std::vector<Pose>{aside, {}, {}, aside});
  EXPECT_TRUE(h.engine.moving_set().empty());
  EXPECT_EQ(h.engine.clearance().distance, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(h.engine.contacts(10).empty());
  const ComponentId block(0);
  h.engine.grab({&block, 1});
  EXPECT_EQ(h.engine.clearance().fixed, ComponentId(1));
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

TEST(CertificateEngine, NeverOverstatesTheClearance) {
  // A peg that shakes in its bore: contacts begin and end within the steps.
  const Assembly assembly =
      scenes::assembly({component("peg", tube(4.95, 0, 0, 20, 24)), component("block", tube(12, 5, 0, 20, 24))});
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  std::mt19937_64 random(3);
  for (int step = 0; step < 60; ++step) {
    const Pose target = scenes::random_pose(random, 0.1, 0.01) * Pose{{0, 0, 0.1 * step}, {}};
    const StepResult r = h.engine.step(target, ResponseKind::Slide);
    EXPECT_LE(r.clearance, h.engine.clearance().distance) << "step " << step;
  }
}

TEST(CertificateEngine, FindsTheFirstContactOfAMotionWithoutMoving) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  const std::vector<Pose> targets = {{{0, 0, 5}, {}}, {{0, 0, -4}, {}}, {{200, 0, 0}, {}}, {{5, 0, -2}, {}}};
  std::vector<FirstContact> found;
  for (const Pose& target : targets) found.push_back(h.engine.first_contact(target));
  EXPECT_TRUE(found[0].free);
  EXPECT_TRUE(found[2].free);
  EXPECT_NEAR(found[1].toi, 0.25, 0.01);
  EXPECT_NEAR(found[3].toi, 0.5, 0.01);
  EXPECT_EQ(found[1].fixed, ComponentId(1));
  EXPECT_EQ(h.engine.poses()[0], Pose{});
}

TEST(CertificateEngine, TellsHowFarTheMovingSetCanGoStraightFromAnyState) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  std::mt19937_64 random(8);
  int free = 0, blocked = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Grabbed h(assembly, states, 0);
    const Pose all = scenes::random_pose(random, 300, 3);
    h.engine.jump(std::vector<Pose>{all * Pose{{0, 0, 3}, quat_about({0, 0, 1}, 0.2)}, all});
    const ComponentId block(0);
    h.engine.grab({&block, 1});
    std::vector<Vec3> displacements;
    std::vector<Pose> targets;
    for (int i = 0; i < 10; ++i) {
      displacements.push_back(scenes::random_vector(random, 30));
      targets.push_back({h.engine.poses()[0].position + displacements.back(), h.engine.poses()[0].rotation});
    }
    const std::vector<FirstContact> straight = h.engine.straight_contacts(displacements);
    for (std::size_t i = 0; i < displacements.size(); ++i) {
      const FirstContact first = h.engine.first_contact(targets[i]);
      ASSERT_EQ(straight[i].free, first.free) << trial << ' ' << i;
      (straight[i].free ? free : blocked) += 1;
      const double off = (first.toi - straight[i].toi) * length(displacements[i]);
      EXPECT_LE(std::abs(off), 8 * states.tolerance) << trial << ' ' << i;
      if (!straight[i].free) {
        EXPECT_EQ(straight[i].fixed, first.fixed);
      }
    }
  }
  EXPECT_GT(free, 50);
  EXPECT_GT(blocked, 50);
}

TEST(CertificateEngine, ReportsTheContactsWithinReach) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  EXPECT_TRUE(h.engine.contacts(0.9).empty());
  const std::vector<ContactPoint> near = h.engine.contacts(1.1);
  ASSERT_FALSE(near.empty());
  for (const ContactPoint& c : near) EXPECT_LE(c.gap, 1.1);
  EXPECT_NEAR(near[0].normal.z, 1, 1e-9);
}

TEST(CertificateEngine, ExemptsAnEmbeddedPairUntilItIsApart) {
  const Assembly assembly = scenes::assembly(
      {component("rod", box({0, 0, 0}, {4, 4, 20})), component("block", box({-10, -10, -10}, {10, 10, 10}))});
  ClassifyOptions classify;
  classify.tolerance = kTolerance;
  classify.fit = 0.05;
  const PairStates states = *classify_pairs(assembly, classify);
  Grabbed h(assembly, states, 0);
  ASSERT_EQ(h.engine.embedded_pairs().size(), 1u);
  for (int step = 1; step <= 30; ++step) h.engine.step({{0, 0, 0.5 * step}, {}}, ResponseKind::Slide);
  EXPECT_TRUE(h.engine.embedded_pairs().empty());
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
    EXPECT_GE(down.engine.poses()[0].position.z, -gap - kTolerance) << "gap " << gap;
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

TEST(CertificateEngine, FindsTheStraightContactOfOneComponentAfterAnyMotion) {
  const Assembly assembly = scenes::assembly(
      {component("block", box({0, 0, 1}, {10, 10, 11})), component("near", box({4, 4, 20}, {6, 6, 22})),
       component("far", box({0, 0, 31}, {10, 10, 32})), component("aside", box({20, 0, 0}, {30, 10, 40}))});
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 1);
  h.engine.step({{100, 0, 0}, {}}, ResponseKind::Stop);
  const ComponentId block(0), near(1), far(2), aside(3);
  const auto first = h.engine.straight_contact(block, near, {0, 0, 500}, StraightSearch::First);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->distance, 9, kTolerance);
  EXPECT_NEAR(first->point.z, 20, kTolerance);
  const auto any = h.engine.straight_contact(block, far, {0, 0, 500}, StraightSearch::Any);
  ASSERT_TRUE(any);
  EXPECT_GE(any->distance, 20 - kTolerance);
  EXPECT_FALSE(h.engine.straight_contact(block, aside, {0, 0, 500}, StraightSearch::First));
  EXPECT_FALSE(h.engine.straight_contact(block, near, {0, 0, 8}, StraightSearch::Any)) << "it does not go that far";
}

TEST(CertificateEngine, LetsFitsOutAlongALine) {
  for (const double interference : {0.005, 0.02, 0.04}) {
    const scenes::SlideScene scene = scenes::press_fit_pin(36, interference);
    const PairStates states = states_of(scene.assembly);
    const CertificateEngine engine(scene.assembly, states);
    EXPECT_FALSE(engine.straight_contact(ComponentId(1), ComponentId(0), {0, 0, 200}, StraightSearch::First));
    EXPECT_TRUE(engine.straight_contact(ComponentId(1), ComponentId(0), {200, 0, 0}, StraightSearch::First));
  }
}

}  // namespace
}  // namespace dismantle
