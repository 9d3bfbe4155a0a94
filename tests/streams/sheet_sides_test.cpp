// SPDX-License-Identifier: Apache-2.0
// Sheets that lie on each other come apart to either side, and pass through each other in neither direction.
#include "dismantle/certificates/ghosts/sheet_sides.h"

#include "dismantle/math/angle.h"
#include "dismantle/streams/streams_motion_engine.h"
#include "tests/certificates/grabbed_component.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace dismantle {
namespace {

using namespace grabbed;
using scenes::component;

TriangleMesh upside_down(TriangleMesh mesh) {
  for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  return mesh;
}

/// A small sheet on a large one, each with either orientation; the small one is component `small`.
std::vector<Assembly> stacked_sheets(std::uint32_t small) {
  std::vector<Assembly> stacks;
  for (const bool first_up : {true, false})
    for (const bool second_up : {true, false}) {
      Component held =
                    component("held", scenes::moved(scenes::sheet(2, 0), {{0.3, 0.2, 0}, quat_about({0, 0, 1}, 0.3)})),
                other = component("other", scenes::sheet(5, 0));
      if (!first_up) held = component("held", upside_down(*held.mesh));
      if (!second_up) other = component("other", upside_down(*other.mesh));
      stacks.push_back(scenes::assembly(small == 0 ? std::vector{held, other} : std::vector{other, held}));
    }
  return stacks;
}

const ResponseKind kResponses[] = {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide};

void grab(MotionEngine& engine, std::uint32_t component) {
  const ComponentId id(component);
  engine.grab({&id, 1});
}

/// Calls `check` with engines of both methods, in which the small sheet is held.
void with_engines(const std::function<void(MotionEngine&, std::uint32_t held, ResponseKind)>& check) {
  for (const std::uint32_t held : {0u, 1u})
    for (const Assembly& assembly : stacked_sheets(held)) {
      const PairStates states = states_of(assembly);
      for (const ResponseKind response : kResponses) {
        SCOPED_TRACE(testing::Message() << "component " << held << ", response " << static_cast<int>(response));
        CertificateEngine certificates(assembly, states);
        grab(certificates, held);
        check(certificates, held, response);
        if (response == ResponseKind::Slide) continue;
        const std::unique_ptr<MotionEngine> streams = make_streams_motion_engine(assembly, states, {});
        grab(*streams, held);
        check(*streams, held, response);
      }
    }
}

TEST(SheetSides, LetSheetsComeApartToEitherSide) {
  with_engines([](MotionEngine& engine, std::uint32_t held, ResponseKind response) {
    for (const double side : {1.0, -1.0, 1.0}) {
      for (int k = 1; k <= 5; ++k)
        EXPECT_TRUE(engine.step({{0.01 * k, 0, 0.3 * kTolerance * k * side}, {}}, response).reached);
      EXPECT_TRUE(engine.step({{0, 0, side}, {}}, response).reached);
      EXPECT_TRUE(engine.overlapping_pairs().empty());
      engine.step({{0, 0, -side}, {}}, ResponseKind::Touch);
      EXPECT_NEAR(engine.poses()[held].position.z, 0, 2 * kTolerance);
      EXPECT_GE(engine.poses()[held].position.z * side, -kTolerance);
      engine.jump(std::vector<Pose>(2));
      grab(engine, held);
    }
  });
}

TEST(SheetSides, LetNoSheetThroughTheOtherOneOnceItHasMoved) {
  with_engines([](MotionEngine& engine, std::uint32_t held, ResponseKind response) {
    for (const double side : {1.0, -1.0}) {
      EXPECT_TRUE(engine.step({{0.1, 0, 0.05 * kTolerance * side}, {}}, response).reached);
      for (int k = 1; k <= 5; ++k) engine.step({{0.1, 0, -0.3 * kTolerance * k * side}, {}}, ResponseKind::Touch);
      EXPECT_GE(engine.poses()[held].position.z * side, -kTolerance);
      engine.jump(std::vector<Pose>(2));
      grab(engine, held);
    }
  });
}

TEST(SheetSides, AreKeptWhereAJumpLeadsBackToTheWayThere) {
  with_engines([](MotionEngine& engine, std::uint32_t held, ResponseKind response) {
    for (const double side : {1.0, -1.0}) {
      EXPECT_TRUE(engine.step({{0.1, 0, 0.2 * kTolerance * side}, {}}, response).reached);
      const std::vector<Pose> before(engine.poses().begin(), engine.poses().end());
      EXPECT_TRUE(engine.step({{0.1, 0, side}, {}}, response).reached);
      engine.jump(before);
      grab(engine, held);
      engine.step({{0.1, 0, -side}, {}}, ResponseKind::Touch);
      EXPECT_GE(engine.poses()[held].position.z * side, -kTolerance);
      EXPECT_TRUE(engine.step({{0.1, 0, side}, {}}, response).reached);
      engine.jump(std::vector<Pose>(2));
      grab(engine, held);
    }
  });
}

TEST(SheetSides, AreTakenIntoAccountByQueries) {
  for (const std::uint32_t held : {0u, 1u})
    for (const Assembly& assembly : stacked_sheets(held)) {
      const Grabbed h(assembly, states_of(assembly), held);
      const ComponentId moving(held), fixed(1 - held);
      for (const Vec3& way : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{1, 0, -0.5}, Vec3{0, 1, 0.5}}) {
        EXPECT_EQ(h.engine.first_contact({way, {}}).toi, 1);
        EXPECT_EQ(h.engine.straight_contacts({&way, 1})[0].toi, 1);
        for (const StraightSearch search : {StraightSearch::Any, StraightSearch::First})
          EXPECT_FALSE(h.engine.straight_contact(moving, fixed, way, search));
      }
      // Tilted about a line in front of it: the arc is tested in many parts, all of them on one side.
      for (const double side : {1.0, -1.0}) {
        const Quat turn = quat_about({0, 1, 0}, side * kTurn / 8);
        const Vec3 hinge{-4, 0, 0};
        EXPECT_EQ(h.engine.first_contact({hinge - mat3_from_quat(turn) * hinge, turn}).toi, 1) << side;
      }
    }
}

TEST(SheetSides, AreOneForSheetsThatAreALittleApart) {
  for (const double gap : {0.05 * kTolerance, 0.3 * kTolerance, 0.9 * kTolerance})
    for (const bool up : {true, false}) {
      const TriangleMesh plain = scenes::sheet(2, gap), upper = up ? plain : upside_down(plain);
      const Assembly assembly = scenes::assembly({component("upper", upper), component("lower", scenes::sheet(5, 0))});
      const PairStates states = states_of(assembly);
      Grabbed down(assembly, states, 0), below(assembly, states, 1);
      for (int k = 1; k <= 20; ++k) {
        down.engine.step({{0, 0, -0.1 * kTolerance * k}, {}}, ResponseKind::Touch);
        below.engine.step({{0, 0, 0.1 * kTolerance * k}, {}}, ResponseKind::Touch);
      }
      EXPECT_GE(down.engine.poses()[0].position.z, -gap - kTolerance) << gap;
      EXPECT_LE(below.engine.poses()[1].position.z, gap + kTolerance) << gap;
      EXPECT_LT(down.engine.first_contact({{0, 0, -1}, {}}).toi, 0.1);
    }
}

TEST(SheetSides, AreOneForASheetAndASolid) {
  const Assembly assembly = scenes::assembly(
      {component("sheet", scenes::sheet(2, 0)), component("block", scenes::box({-5, -5, -5}, {5, 5, 0}))});
  Grabbed h(assembly, states_of(assembly), 0);
  h.engine.step({{0, 0, -1}, {}}, ResponseKind::Touch);
  EXPECT_GE(h.engine.poses()[0].position.z, -kTolerance);
}

TEST(SheetSides, DecideOnceAMotionHasBegun) {
  const auto at = [](double z) { return RigidTransform{Mat3{}, {0, 0, z}}; };
  SheetSides sides{true, {}, {0, 0, 1}};
  EXPECT_FALSE(sides.begin_motion(true, at(1), 0.01));
  EXPECT_TRUE(sides.begin_motion(true, at(-1), 0.01)) << "nothing has moved yet";
  EXPECT_TRUE(sides.mirrored);
  EXPECT_FALSE(sides.begin_motion(false, at(1), 0.01));
  EXPECT_FALSE(sides.begin_motion(true, at(1), 0.01)) << "returned by a motion, not by a jump";
  EXPECT_FALSE(sides.jump(false, at(0.005), 0.01)) << "the ghosts of both sides may be apart there";
  EXPECT_TRUE(sides.mirrored);
  EXPECT_TRUE(sides.jump(false, at(0.5), 0.01));
  EXPECT_FALSE(sides.mirrored);
  EXPECT_TRUE(sides.jump(false, at(-0.5), 0.01));
  EXPECT_TRUE(sides.jump(true, at(0), 0.01));
  EXPECT_TRUE(sides.begin_motion(true, at(-1), 0.01));
  SheetSides one;
  EXPECT_FALSE(one.begin_motion(true, at(-1), 0.01));
  EXPECT_FALSE(one.jump(false, at(-1), 0.01));
}

}  // namespace
}  // namespace dismantle
