// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/certificate_queries.h"

#include "dismantle/surface/surface_queries.h"
#include "tests/certificates/grabbed_component.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"
#include "tests/support/slide_scenes.h"
#include "tests/support/swept_meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace dismantle {
namespace {

using namespace grabbed;
using scenes::box;
using scenes::component;
using scenes::tube;

TEST(CertificateQueries, AnyFrontGivesTheSameFirstContact) {
  std::mt19937_64 random(21);
  const Assembly assembly = scenes::random_assembly(random, 14, 5);
  const PairStates states = states_of(assembly);
  Grabbed used(assembly, states, 0);
  CertificateOptions options;
  options.prepared = used.engine.surfaces();
  for (int step = 0; step < 60; ++step) {
    const Pose target = scenes::random_pose(random, 6, 0.5);
    Grabbed fresh(assembly, states, 0, options);
    fresh.engine.jump(used.engine.poses());
    const ComponentId id(0);
    fresh.engine.grab({&id, 1});
    const Pose by_used = used.engine.step(target, ResponseKind::Touch).pose;
    const Pose by_fresh = fresh.engine.step(target, ResponseKind::Touch).pose;
    EXPECT_NEAR(length(by_used.position - by_fresh.position), 0, kTolerance) << "step " << step;
  }
}

TEST(CertificateQueries, MeasuresTheClearanceExactly) {
  std::mt19937_64 random(31);
  const Assembly assembly = scenes::random_assembly(random, 8, 8);
  const PairStates states = states_of(assembly);
  for (std::uint32_t c = 0; c < 8; ++c) {
    Grabbed h(assembly, states, c);
    const AssemblySurface surface = make_assembly_surface(assembly, Executor());
    double minimum = 1e9;
    for (std::uint32_t k = 0; k < 8; ++k)
      if (k != c && !(states.find(ComponentId(c), ComponentId(k)) &&
                      states.find(ComponentId(c), ComponentId(k))->state == PairState::Overlapping))
        minimum = std::min(minimum, surface_distance(surface, ComponentId(c), ComponentId(k), 1e9));
    const Clearance clearance = h.engine.clearance();
    EXPECT_NEAR(clearance.distance, minimum, 1e-9);
    EXPECT_NEAR(length(clearance.point_moving - clearance.point_fixed), clearance.distance, 1e-9);
    EXPECT_FALSE(h.engine.clearance(clearance.distance).fixed.valid()) << "nothing is nearer";
    EXPECT_EQ(h.engine.clearance(clearance.distance + 0.1).fixed, clearance.fixed);
  }
}

TEST(CertificateQueries, NamesTheFirstOfEquallyNearComponents) {
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

TEST(CertificateQueries, GivesNearFacesAndTheirContactsAsOfTheMovingSet) {
  const Assembly assembly =
      scenes::assembly({component("peg", tube(4.95, 0, 0, 20, 24)), component("block", tube(12, 5, 0, 20, 24))});
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  h.engine.jump(std::vector<Pose>{{{0.04, 0.01, 3}, {}}, {}});
  const ComponentId peg(0);
  h.engine.grab({&peg, 1});
  std::size_t most = 0;
  for (const double reach : {0.0, 0.02, 0.2, 3.0}) {
    const std::vector<ContactPoint> contacts = h.engine.contacts(reach);
    const std::vector<NearFaces> near = h.engine.near_faces(peg, reach);
    ASSERT_EQ(near.size(), contacts.size()) << reach;
    for (std::size_t i = 0; i < near.size(); ++i) EXPECT_EQ(h.engine.contact(near[i]), contacts[i]) << reach;
    EXPECT_GE(near.size(), most);
    most = near.size();
  }
  EXPECT_GT(most, 100u);
}

TEST(CertificateQueries, NeverOverstatesTheClearance) {
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

TEST(CertificateQueries, FindsTheFirstContactOfAMotionWithoutMoving) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  const std::vector<Pose> targets = {{{0, 0, 5}, {}}, {{0, 0, -4}, {}}, {{200, 0, 0}, {}}, {{5, 0, -2}, {}}};
  std::vector<FirstContact> found;
  found.reserve(targets.size());
  for (const Pose& target : targets) found.push_back(h.engine.first_contact(target));
  EXPECT_TRUE(found[0].free);
  EXPECT_TRUE(found[2].free);
  EXPECT_NEAR(found[1].toi, 0.25, 0.01);
  EXPECT_NEAR(found[3].toi, 0.5, 0.01);
  EXPECT_EQ(found[1].fixed, ComponentId(1));
  EXPECT_EQ(h.engine.poses()[0], Pose{});
}

TEST(CertificateQueries, TellsHowFarTheMovingSetCanGoStraightFromAnyState) {
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

TEST(CertificateQueries, ReportsTheContactsWithinReach) {
  const Assembly assembly = block_and_floor();
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  EXPECT_TRUE(h.engine.contacts(0.9).empty());
  const std::vector<ContactPoint> near = h.engine.contacts(1.1);
  ASSERT_FALSE(near.empty());
  for (const ContactPoint& c : near) EXPECT_LE(c.gap, 1.1);
  EXPECT_NEAR(near[0].normal.z, 1, 1e-9);
}

TEST(CertificateQueries, FindsTheStraightContactOfOneComponentAfterAnyMotion) {
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

TEST(CertificateQueries, FindsAContactNearTheFirstOneOfAPairWhoseDepthIsBounded) {
  const TriangleMesh rod = tube(1, 0, -10, 10, 12);
  const Assembly assembly =
      scenes::assembly({component("rod", rod),
                        component("across", scenes::moved(rod, {{1.4, 0, 0}, quat_about({1, 0, 0}, kTurn / 4)}))});
  const PairStates states = states_of(assembly);
  const CertificateEngine engine(assembly, states);
  const ComponentId moving(0), fixed(1);
  const auto first = engine.straight_contact(moving, fixed, {30, 0, 0}, StraightSearch::First);
  const auto near = engine.straight_contact(moving, fixed, {30, 0, 0}, StraightSearch::Near);
  ASSERT_TRUE(first);
  ASSERT_TRUE(near);
  EXPECT_LE(first->distance, 0.4) << "from there on, the depth is that of an axis";
  EXPECT_GE(near->distance, first->distance - kTolerance);
  EXPECT_LE(near->distance, 0.4);
  EXPECT_LE(std::abs(near->point.x), 2.4 + kTolerance) << "on the fixed rod";
  EXPECT_FALSE(engine.straight_contact(moving, fixed, {-30, 0, 0}, StraightSearch::Near)) << "it is free that way";
}

TEST(CertificateQueries, SaysWhereAQuickSearchWasGivenUp) {
  const TriangleMesh rod = tube(1, 0, -10, 10, 12);
  const Assembly assembly =
      scenes::assembly({component("rod", rod),
                        component("across", scenes::moved(rod, {{1.4, 0, 0}, quat_about({1, 0, 0}, kTurn / 4)}))});
  const PairStates states = states_of(assembly);
  bool is_over = false;
  CertificateOptions options;
  options.keep_going = [&] { return !is_over; };
  const CertificateEngine engine(assembly, states, options);
  const auto quick = [&](double way) {
    return engine.straight_contact(ComponentId(0), ComponentId(1), {way, 0, 0}, StraightSearch::Quick);
  };
  EXPECT_FALSE(quick(-30));
  ASSERT_TRUE(quick(30));
  EXPECT_TRUE(quick(30)->is_certain);
  is_over = true;
  ASSERT_TRUE(quick(-30));
  EXPECT_FALSE(quick(-30)->is_certain);
  EXPECT_TRUE(engine.straight_contact(ComponentId(0), ComponentId(1), {-30, 0, 0}, StraightSearch::Any))
      << "what is not decided counts as a contact";
}

TEST(CertificateQueries, LetsFitsOutAlongALine) {
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
