// SPDX-License-Identifier: Apache-2.0
// The guarantee of ghost surfaces (docs/design/0012-ghost-surfaces.md), by a depth that shares no code with the engine.
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/math/angle.h"
#include "tests/certificates/grabbed_component.h"
#include "tests/support/depth_oracle.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/swept_meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

using namespace grabbed;
using scenes::component;

constexpr double kRounding = 1e-9;

/// A pyramid on its tip, with edges or faces along the diagonals of a mesh.
TriangleMesh needle(double degrees, double height, double tip) {
  const double b = height * std::tan(degrees * 3.14159265358979 / 360);
  return {{{0, 0, tip}, {b, b, tip + height}, {-b, b, tip + height}, {-b, -b, tip + height}, {b, -b, tip + height}},
          {{{0, 2, 1}}, {{0, 3, 2}}, {{0, 4, 3}}, {{0, 1, 4}}, {{1, 2, 3}}, {{1, 3, 4}}}};
}

/// A square pyramid with its apex, which points up, at the origin.
TriangleMesh pyramid() {
  return {{{0, 0, 0}, {2, 2, -2}, {-2, 2, -2}, {-2, -2, -2}, {2, -2, -2}},
          {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 4}}, {{0, 4, 1}}, {{1, 3, 2}}, {{1, 4, 3}}}};
}

/// A knife on its edge.
TriangleMesh wedge(double degrees, double length, double height, double edge) {
  const double b = height * std::tan(degrees * 3.14159265358979 / 360), top = edge + height;
  return {{{-length, 0, edge},
           {length, 0, edge},
           {length, b, top},
           {-length, b, top},
           {length, -b, top},
           {-length, -b, top}},
          {{{0, 1, 2}}, {{0, 2, 3}}, {{1, 0, 5}}, {{1, 5, 4}}, {{3, 2, 4}}, {{3, 4, 5}}, {{1, 4, 2}}, {{0, 3, 5}}}};
}

TriangleMesh turned(TriangleMesh mesh, double angle, Vec3 shift = {}) {
  return scenes::moved(std::move(mesh), {shift, quat_about({0, 0, 1}, angle)});
}

TriangleMesh upside_down(TriangleMesh mesh) {
  for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  return mesh;
}

TriangleMesh at(const Component& c, const Pose& pose) {
  return scenes::moved(*c.mesh, pose);
}

/// The depth of components 0 and 1 now, by samples.
double depth_now(const Assembly& assembly, const CertificateEngine& engine, double step) {
  return oracle::sampled_depth(at(assembly.components[0], engine.poses()[0]),
                               at(assembly.components[1], engine.poses()[1]), step)
      .depth;
}

/// Presses component 0 down onto component 1 in steps. @return its height at the end
double pressed(const Assembly& assembly, ResponseKind response, int steps = 20, double step = -0.05) {
  const PairStates states = states_of(assembly);
  Grabbed h(assembly, states, 0);
  for (int k = 1; k <= steps; ++k) {
    h.engine.step({{0, 0, step * k}, {}}, response);
    EXPECT_LE(depth_now(assembly, h.engine, 10), kTolerance + kRounding) << "step " << k;
  }
  return h.engine.poses()[0].position.z;
}

const ResponseKind kResponses[] = {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide};

TEST(GhostEngine, StopsTipsAndEdgesThatArePressedOnAFaceAlongItsMesh) {
  const double quarter = 3.14159265358979 / 4;
  for (const double offset : {0.0, 2e-6, -3e-6}) {
    const TriangleMesh shapes[] = {turned(needle(20, 30, 0.52), quarter, {offset, 0, 0}),
                                   turned(needle(5, 30, 0.52), 0, {offset, offset, 0}),
                                   turned(wedge(2, 40, 30, 0.52), quarter, {0, offset, 0}),
                                   turned(wedge(20, 3, 5, 0.52), quarter, {offset, 0, 0})};
    for (const TriangleMesh& shape : shapes)
      for (const ResponseKind response : kResponses) {
        const Assembly assembly =
            scenes::assembly({component("tip", shape), component("block", scenes::box({-20, -20, -20}, {20, 20, 0}))});
        SCOPED_TRACE(testing::Message() << "offset " << offset << " shape " << (&shape - shapes) << " response "
                                        << static_cast<int>(response));
        const double height = pressed(assembly, response);
        EXPECT_GE(height, -0.52 - kTolerance);
        EXPECT_LE(height, response == ResponseKind::Touch ? -0.52 + kTolerance : -0.5);
      }
  }
}

TEST(GhostEngine, PassesNothingThroughASheetThatRestsOnASolid) {
  for (const bool up : {true, false})
    for (const double height : {0.0, 0.003, 0.03}) {
      const TriangleMesh plain = scenes::sheet(3, height), sheet = up ? plain : upside_down(plain);
      const Assembly assembly =
          scenes::assembly({component("sheet", sheet), component("cube", scenes::box({-20, -20, -20}, {20, 20, 0}))});
      const PairStates states = states_of(assembly);
      for (const ResponseKind response : kResponses) {
        SCOPED_TRACE(testing::Message() << "up " << up << " height " << height << " response "
                                        << static_cast<int>(response));
        Grabbed cube(assembly, states, 1), sheet_down(assembly, states, 0), sheet_up(assembly, states, 0);
        for (int k = 1; k <= 30; ++k) {
          cube.engine.step({{0, 0, 0.1 * k}, {}}, response);
          sheet_down.engine.step({{0, 0, -0.1 * k}, {}}, response);
          sheet_up.engine.step({{0, 0, 0.1 * k}, {}}, response);
        }
        EXPECT_LE(cube.engine.poses()[1].position.z, height + kTolerance);
        EXPECT_GE(sheet_down.engine.poses()[0].position.z, -height - kTolerance);
        EXPECT_NEAR(sheet_up.engine.poses()[0].position.z, 3, 1e-9);
      }
    }
}

TEST(GhostEngine, PassesNothingThroughAFoilThinnerThanTheTolerance) {
  for (const double thickness : {0.1, 0.4, 1.0, 10.0})
    for (const ResponseKind response : kResponses) {
      const Assembly assembly =
          scenes::assembly({component("weight", scenes::box({-3, -3, 0.5}, {3, 3, 4})),
                            component("foil", scenes::box({-20, -20, -thickness * kTolerance}, {20, 20, 0}))});
      EXPECT_GE(pressed(assembly, response, 60), -0.5 - kTolerance) << thickness;
    }
}

TEST(GhostEngine, LetsContactsWithDepthSlideAsTheyAre) {
  // The tip of a needle is six tenths of the tolerance deep, nearly all the play that faces have against all others.
  for (const double depth : {0.003, 0.006, 0.0095}) {
    const Assembly assembly = scenes::assembly({component("needle", turned(needle(30, 4, -depth), 0.3)),
                                                component("block", scenes::box({-6, -6, -6}, {6, 6, 0}))});
    const PairStates states = states_of(assembly);
    for (const ResponseKind response : kResponses) {
      Grabbed h(assembly, states, 0);
      for (int k = 1; k <= 8; ++k)
        EXPECT_TRUE(h.engine.step({{-1.0 * k, 0.3 * k, 0}, {}}, response).reached) << depth << ", step " << k;
    }
  }
}

TEST(GhostEngine, TakesAKnifeThatPiercesAFoilOutToOneSideOnly) {
  // The edge is 5.7 um below a foil of 2.5 um; the foil is less than 3 um deep in the knife.
  TriangleMesh foil = scenes::box({-5, -5, -0.0025}, {5, 5, 0});
  const Assembly assembly =
      scenes::assembly({component("knife", wedge(36, 2, 2, -0.00825)), component("foil", std::move(foil))});
  const PairStates states = states_of(assembly);
  Grabbed through(assembly, states, 0), out(assembly, states, 0);
  double lowest = 0;
  for (int k = 1; k <= 40; ++k)
    lowest = std::min(lowest, through.engine.step({{0, 0, -0.01 * k}, {}}, ResponseKind::Touch).pose.position.z);
  EXPECT_GE(lowest, -2 * kTolerance);
  for (int k = 1; k <= 10; ++k) EXPECT_TRUE(out.engine.step({{0, 0, 0.1 * k}, {}}, ResponseKind::Touch).reached);
}

/// A random convex or hollow shape of about 2 mm.
TriangleMesh random_shape(std::mt19937_64& random) {
  switch (random() % 5) {
    case 0:
      return needle(10 + static_cast<double>(random() % 60), 2, -1);
    case 1:
      return wedge(5 + static_cast<double>(random() % 60), 1, 2, -1);
    case 2:
      return scenes::box({-1, -0.6, -0.3}, {1, 0.6, 0.3});
    case 3:
      return scenes::tube(1, 0.6, -0.8, 0.8, 6 + static_cast<std::uint32_t>(random() % 5));
    default:
      return scenes::box({-1, -1, -0.004}, {1, 1, 0.004});  // a foil
  }
}

TEST(GhostEngine, LetsASheetSlideAlongWhatItTouchesSomewhereElse) {
  // At first one cell of the sheet touches the block, then the others.
  const Assembly assembly = scenes::assembly({component("sheet", turned(scenes::sheet(8, 0), 0.1, {7, 0, 0})),
                                              component("block", scenes::box({-3, -3, -3}, {0, 3, 0}))});
  const PairStates states = states_of(assembly);
  for (const ResponseKind response : kResponses) {
    Grabbed sheet(assembly, states, 0);
    for (int k = 1; k <= 10; ++k) EXPECT_TRUE(sheet.engine.step({{-1.0 * k, 0.1 * k, 0}, {}}, response).reached);
    sheet.engine.step({{-10, 1, -5}, {}}, response);
    EXPECT_GE(sheet.engine.poses()[0].position.z, -kTolerance);
  }
}

TEST(GhostEngine, LetsASheetGoThatATipPokesThroughWithinTheTolerance) {
  const Assembly assembly =
      scenes::assembly({component("sheet", turned(scenes::sheet(3, -0.5 * kTolerance), 0.3, {0.7, 0.4, 0})),
                        component("tip", pyramid())});
  const PairStates states = states_of(assembly);
  for (const ResponseKind response : kResponses) {
    Grabbed aside(assembly, states, 0), up(assembly, states, 0), down(assembly, states, 0);
    EXPECT_TRUE(aside.engine.step({{-2, 1, 0}, {}}, response).reached);
    EXPECT_TRUE(up.engine.step({{0, 0, 2}, {}}, response).reached);
    down.engine.step({{0, 0, -1}, {}}, response);
    EXPECT_GE(down.engine.poses()[0].position.z, -2 * kTolerance);
  }
}

/// A flat square sheet of n x n cells of two triangles.
TriangleMesh cells(double half, std::uint32_t n) {
  TriangleMesh sheet;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j)
      sheet.vertices.push_back({half * (2.0 * i / n - 1), half * (2.0 * j / n - 1), 0});
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t v = i * (n + 1) + j, w = v + n + 1;
      sheet.faces.push_back({{v, w, w + 1}});
      sheet.faces.push_back({{v, w + 1, v + 1}});
    }
  return sheet;
}

TEST(GhostEngine, LetsASheetSlideOnATipThatItTouches) {
  const Assembly assembly =
      scenes::assembly({component("sheet", turned(cells(3, 8), 0.3, {0.7, 0.4, 0})), component("tip", pyramid())});
  const PairStates states = states_of(assembly);
  for (const ResponseKind response : kResponses) {
    Grabbed aside(assembly, states, 0), down(assembly, states, 0);
    for (int k = 1; k <= 20; ++k) EXPECT_TRUE(aside.engine.step({{-0.1 * k, 0.07 * k, 0}, {}}, response).reached);
    for (Grabbed* pressed : {&aside, &down}) {
      Pose target = pressed->engine.poses()[0];
      target.position.z = -1;
      pressed->engine.step(target, response);
      // It may tilt: the height of its plane over the tip.
      const RigidTransform now = transform_from_pose(pressed->engine.poses()[0]);
      const Vec3 normal = now.rotation * Vec3{0, 0, 1};
      EXPECT_GE(dot(normal, now.translation) / normal.z, -kTolerance);
    }
  }
}

TEST(GhostEngine, LetsASheetSlideOnATipThatPiercesItAtAVertex) {
  for (const double depth : {0.0, 0.2 * kTolerance, 0.8 * kTolerance}) {
    const TriangleMesh sheet = scenes::moved(cells(3, 8), {{0, 0, -depth}, {}});
    const Assembly assembly = scenes::assembly({component("sheet", sheet), component("tip", pyramid())});
    const PairStates states = states_of(assembly);
    for (const ResponseKind response : kResponses) {
      Grabbed sheet_moves(assembly, states, 0), tip_moves(assembly, states, 1);
      for (int k = 1; k <= 20; ++k)
        for (Grabbed* moving : {&sheet_moves, &tip_moves})
          EXPECT_TRUE(moving->engine.step({{-0.1 * k, 0.07 * k, 0}, {}}, response).reached) << "depth " << depth;
    }
  }
}

TEST(GhostEngine, LetsASheetSlideAtTheHeightOfWhatItIsNear) {
  const double gap = 0.05 * kTolerance;
  const TriangleMesh bent{{{-2, -1, gap}, {-2, 1, gap}, {4, -1, gap}, {4, 1, gap}, {6, -1, 0}, {6, 1, 0}},
                          {{{0, 2, 1}}, {{1, 2, 3}}, {{2, 4, 3}}, {{3, 4, 5}}}};
  for (const TriangleMesh& sheet : {bent, upside_down(bent)}) {
    const Assembly assembly =
        scenes::assembly({component("sheet", sheet), component("block", scenes::box({-20, -20, -5}, {3, 20, 0}))});
    for (const ResponseKind response : kResponses) {
      Grabbed moving(assembly, states_of(assembly), 0);
      for (int k = 1; k <= 20; ++k) EXPECT_TRUE(moving.engine.step({{-0.4 * k, 0.1 * k, 0}, {}}, response).reached);
      moving.engine.step({{-8, 2, -1}, {}}, ResponseKind::Touch);
      EXPECT_GE(moving.engine.poses()[0].position.z, -kTolerance);
    }
  }
}

TEST(GhostEngine, LetsASheetSlideOnAnotherOneThatItStandsOn) {
  const TriangleMesh upright = scenes::moved(cells(2, 1), {{0.3, 0.2, 2}, quat_about({1, 0, 0}, kTurn / 4)});
  for (const TriangleMesh& upper : {upright, upside_down(upright)})
    for (const TriangleMesh& lower : {cells(1.5, 8), upside_down(cells(1.5, 8))}) {
      const Assembly assembly = scenes::assembly({component("upper", upper), component("lower", lower)});
      const PairStates states = states_of(assembly);
      for (const ResponseKind response : kResponses) {
        Grabbed upper_moves(assembly, states, 0), lower_moves(assembly, states, 1), down(assembly, states, 0);
        for (int k = 1; k <= 20; ++k) {
          const Vec3 way{-0.05 * k, 0.03 * k, 0};
          EXPECT_TRUE(upper_moves.engine.step({way, {}}, response).reached);
          EXPECT_TRUE(lower_moves.engine.step({way, {}}, response).reached);
        }
        upper_moves.engine.step({{-1, 0.6, -1}, {}}, response);
        down.engine.step({{0, 0, -1}, {}}, response);
        for (const Grabbed* pressed : {&upper_moves, &down})
          for (const Vec3& p : at(assembly.components[0], pressed->engine.poses()[0]).vertices)
            EXPECT_GE(p.z, -kTolerance);
      }
    }
}

TEST(GhostEngine, PassesNoPlateThroughAFoilThatItRestsOn) {
  for (const double thick : {0.1, 0.5, 1.5})
    for (const double thin : {0.1, 0.5, 1.5}) {
      const Assembly assembly =
          scenes::assembly({component("plate", scenes::box({-3, -3, 0}, {3, 3, thick * kTolerance})),
                            component("foil", scenes::box({-9, -9, -thin * kTolerance}, {9, 9, 0}))});
      for (const ResponseKind response : kResponses) {
        SCOPED_TRACE(testing::Message() << thick << " on " << thin << ", " << static_cast<int>(response));
        EXPECT_GE(pressed(assembly, response, 5), -kTolerance);
        Grabbed plate(assembly, states_of(assembly), 0);
        EXPECT_TRUE(plate.engine.step({{4, 2, 0}, {}}, response).reached);
        plate.engine.step({{4, 2, -1}, {}}, response);
        EXPECT_GE(plate.engine.poses()[0].position.z, -kTolerance);
      }
    }
}

TEST(GhostEngine, NeverGetsDeeperThanTheTolerance) {
  std::mt19937_64 random(20261123);
  int contacts = 0;
  for (int member = 0; member < 60; ++member) {
    SCOPED_TRACE(member);
    const TriangleMesh a = scenes::moved(random_shape(random), scenes::random_pose(random, 0.1, 3));
    const TriangleMesh b = scenes::moved(random_shape(random), scenes::random_pose(random, 0.1, 3));
    const Assembly assembly = scenes::assembly({component("a", scenes::moved(a, {{0, 0, 4}, {}})), component("b", b)});
    const PairStates states = states_of(assembly);
    Grabbed h(assembly, states, 0);
    const ResponseKind response = kResponses[member % 3];
    std::vector<Pose> made{{}};
    for (int k = 0; k < 25; ++k) {
      const Vec3 towards = scenes::random_vector(random, 0.6) - Vec3{0, 0, 5};
      const Pose target{towards, quat_about(normalized(scenes::random_vector(random, 1)), 0.3)};
      const StepResult step = h.engine.step(target, response);
      contacts += step.reached ? 0 : 1;
      made.insert(made.end(), step.poses.begin(), step.poses.end());
      ASSERT_LE(depth_now(assembly, h.engine, 0.25), kTolerance + kRounding) << "step " << k;
    }
    // What was free one way is free the other way; parts of slides are cut at other poses on the way back.
    for (std::size_t k = made.size() - 1; k-- > 0 && response != ResponseKind::Slide;)
      ASSERT_TRUE(h.engine.step(made[k], ResponseKind::Stop).reached) << "back to pose " << k;
  }
  EXPECT_GT(contacts, 300);
}

}  // namespace
}  // namespace dismantle
