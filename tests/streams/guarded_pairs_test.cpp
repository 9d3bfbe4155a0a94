// SPDX-License-Identifier: Apache-2.0
// The guarantee (docs/guarantee.md) as the method `streams` holds it, by the depth of solids and beside the method
// `certificates`.
#include "dismantle/streams/guarded_pairs.h"

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/streams/streams_motion_engine.h"
#include "dismantle/surface/depth/solid_depth.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

using scenes::component;

constexpr double kTolerance = 0.01;

PairStates states_of(const Assembly& assembly) {
  ClassifyOptions options;
  options.tolerance = kTolerance;
  return classify_pairs(assembly, options).value();
}

/// Two components, of which the first has been grabbed.
struct Held {
  Assembly assembly;
  PairStates states;
  std::unique_ptr<MotionEngine> engine;

  Held(TriangleMesh held, TriangleMesh other)
      : assembly(scenes::assembly({component("held", std::move(held)), component("other", std::move(other))})),
        states(states_of(assembly)),
        engine(make_streams_motion_engine(assembly, states, {})),
        shapes{SolidShape(assembly.components[0]), SolidShape(assembly.components[1])} {
    engine->grab(std::vector<ComponentId>{ComponentId(0)});
  }
  /// Moves towards targets along a line, step by step. @return the way gone
  double go(Vec3 step, int count) {
    const Vec3 from = position();
    for (int k = 1; k <= count; ++k) {
      engine->step({from + static_cast<double>(k) * step, {}}, ResponseKind::Touch);
      deepest = std::max(deepest, depth());
    }
    return dot(position() - from, normalized(step));
  }
  Vec3 position() const { return engine->poses()[0].position; }
  /// The depth of the two solids, a lower bound within 1%.
  double depth() const {
    const auto at = [&](int c) { return PlacedShape{&shapes[c], transform_from_pose(engine->poses()[c])}; };
    return solid_depth(at(0), at(1)).attained;
  }
  SolidShape shapes[2];
  double deepest = 0;
};

/// A pyramid on its tip.
TriangleMesh needle(double tip) {
  const double b = 0.4;
  return scenes::moved({{{0, 0, tip}, {b, b, tip + 2}, {-b, b, tip + 2}, {-b, -b, tip + 2}, {b, -b, tip + 2}},
                        {{{0, 2, 1}}, {{0, 3, 2}}, {{0, 4, 3}}, {{0, 1, 4}}, {{1, 2, 3}}, {{1, 3, 4}}}},
                       {{}, quat_about({0, 0, 1}, 3.14159265358979 / 4)});
}

TEST(StepTowards, TakesARotationForTheSameWithAllItsSignsChanged) {
  Held held(needle(0.5), scenes::box({-2, -2, -2}, {2, 2, 0}));
  const Pose up{{0, 0, 1}, quat_about({0, 0, 1}, 0.3)};
  ASSERT_TRUE(held.engine->step(up, ResponseKind::Touch).reached);
  const StepResult stay = held.engine->step({up.position, -up.rotation}, ResponseKind::Touch);
  EXPECT_TRUE(stay.reached);
  EXPECT_TRUE(stay.poses.empty());
  EXPECT_EQ(held.engine->poses()[0], up);
}

TEST(GuardedPairs, StopANeedleOnAnEdgeOfAFace) {
  Held held(needle(0.5), scenes::box({-2, -2, -2}, {2, 2, 0}));
  EXPECT_NEAR(held.go({0, 0, -0.05}, 30), 0.5, kTolerance);
  EXPECT_LE(held.deepest, kTolerance);
}

TEST(GuardedPairs, LetNothingThroughSheetsAndFoils) {
  for (const bool up : {true, false}) {
    TriangleMesh sheet = scenes::sheet(3, 0);
    if (!up)
      for (Face& f : sheet.faces) std::swap(f.v[1], f.v[2]);
    const TriangleMesh cube = scenes::box({-5, -5, -5}, {5, 5, 0});
    EXPECT_LE(Held(cube, sheet).go({0, 0, 0.1}, 60), kTolerance);
    EXPECT_LE(Held(sheet, cube).go({0, 0, -0.1}, 60), kTolerance);
    EXPECT_NEAR(Held(sheet, cube).go({0, 0, 0.1}, 20), 2, 1e-9);
  }
  const TriangleMesh foil = scenes::box({-5, -5, -0.3 * kTolerance}, {5, 5, 0});
  EXPECT_NEAR(Held(scenes::box({-1, -1, 1}, {1, 1, 2}), foil).go({0, 0, -0.05}, 60), 1, kTolerance);
}

/// A block 0.05 mm deep in a floor: the pair gets ghosts of its own.
Held block_in_floor() {
  return {scenes::box({-1, -1, -0.05}, {1, 1, 2}), scenes::box({-5, -5, -5}, {5, 5, 0})};
}

TEST(GuardedPairs, KeepTheDepthOfAnOverlapUntilTheyAreApart) {
  Held held = block_in_floor();
  ASSERT_EQ(held.engine->overlapping_pairs().size(), 1u);
  EXPECT_NEAR(held.go({0.1, 0.03, 0}, 20), 2 * std::hypot(1, 0.3), 1e-9);
  EXPECT_LE(held.go({0, 0, -0.02}, 10), 1.25 * kTolerance + 0.25 * 0.05);
  EXPECT_LE(held.deepest, 1.25 * (0.05 + kTolerance));
  EXPECT_GT(held.go({0, 0, 0.1}, 5), 0.48);
  EXPECT_TRUE(held.engine->overlapping_pairs().empty());
  held.go({0, 0, -0.1}, 10);
  EXPECT_NEAR(held.position().z, 0.05, kTolerance);
}

TEST(GuardedPairs, HaveTheirAllowanceAgainAfterAJumpBack) {
  Held held = block_in_floor();
  held.go({0, 0, 0.1}, 5);
  ASSERT_TRUE(held.engine->overlapping_pairs().empty());
  held.engine->jump(std::vector<Pose>(2));
  EXPECT_EQ(held.engine->overlapping_pairs().size(), 1u);
  held.engine->grab(std::vector<ComponentId>{ComponentId(0)});
  EXPECT_NEAR(held.go({0.1, 0, 0}, 5), 0.5, 1e-9);
}

TEST(GuardedPairs, BoundTheDepthOfAnOverlapForWhichNoGhostsAreFound) {
  // A pin of radius 4 in a bore of radius 2.5.
  Held held(scenes::tube(4, 0, 2, 9, 9, 1), scenes::tube(12, 2.5, 0, 5, 12, 1));
  const GuardedPairs pairs(held.assembly, held.states, make_assembly_triangles(held.assembly, {}), {});
  ASSERT_EQ(pairs.rules().find(0, 1).test, PairTest::None);
  const double allowed = held.engine->overlapping_pairs().at(0).allowed_depth;
  EXPECT_GT(allowed, 0.5);
  EXPECT_LT(held.go({0.5, 0, 0}, 4), 0.5);
  EXPECT_LE(held.deepest, allowed);
  EXPECT_NEAR(held.go({0, 0, 1}, 4), 4, 1e-9);
  EXPECT_TRUE(held.engine->overlapping_pairs().empty());
  EXPECT_NEAR(held.go({0, 0, -1}, 4), 1, 2 * kTolerance);
}

TEST(GuardedPairs, GrowBoundsByNoLessThanAnyGhostIsDisplaced) {
  const Held held = block_in_floor();
  const AssemblyTriangles triangles = make_assembly_triangles(held.assembly, {});
  const GuardedPairs pairs(held.assembly, held.states, triangles, {});
  const GhostVertices& ghosts = pairs.ghosts();
  const PairRule rule = pairs.rules().find(0, 1);
  ASSERT_GT(ghosts.displaced.size(), triangles.vertices.size());
  double longest = 0;
  for (NodeIndex leaf = 0; leaf < triangles.faces.size(); ++leaf)
    for (const std::uint32_t v : triangles.faces[leaf].v)
      for (const std::uint32_t slot : {0u, triangles.bvh.component_of[leaf] == 0 ? rule.ghost_a : rule.ghost_b}) {
        const double displaced = length(ghosts.displaced[v + slot] - triangles.vertices[v]);
        EXPECT_LT(displaced, ghosts.margins[leaf]);
        longest = std::max(longest, displaced);
      }
  EXPECT_GT(longest, 0.02);
}

TriangleMesh random_shape(std::mt19937_64& random) {
  switch (random() % 4) {
    case 0:
      return needle(-1);
    case 1:
      return scenes::box({-1, -0.6, -0.3}, {1, 0.6, 0.3});
    case 2:
      return scenes::tube(1, 0.6, -0.8, 0.8, 6 + static_cast<std::uint32_t>(random() % 5), 1);
    default:
      return scenes::box({-1, -1, -0.004}, {1, 1, 0.004});  // a foil
  }
}

TEST(GuardedPairs, AllowWhatTheMethodCertificatesAllows) {
  std::mt19937_64 random(20261124);
  int blocked = 0, overlapping = 0, with_ghosts = 0;
  for (int member = 0; member < 16; ++member) {
    SCOPED_TRACE(member);
    // Some pairs overlap in the assembled state.
    const double height = member % 4 != 1 ? 4 : 0.9;
    Held held(scenes::moved(random_shape(random), {{0, 0, height}, {}}),
              scenes::moved(random_shape(random), scenes::random_pose(random, 0.1, 3)));
    CertificateEngine expected(held.assembly, held.states);
    const GuardedPairs pairs(held.assembly, held.states, make_assembly_triangles(held.assembly, {}), {});
    const bool has_ghosts = pairs.rules().find(0, 1).test != PairTest::None;
    for (int k = 0; k < (member % 4 != 1 ? 12 : 4); ++k) {
      const Pose target{scenes::random_vector(random, 0.6) - Vec3{0, 0, height},
                        quat_about(normalized(scenes::random_vector(random, 1)), k % 2 == 0 ? 0 : 0.3)};
      expected.jump(held.engine->poses());
      expected.grab(held.engine->moving_set());
      overlapping += held.engine->overlapping_pairs().empty() ? 0 : 1;
      const StepResult mine = held.engine->step(target, ResponseKind::Touch);
      const StepResult other = expected.step(target, ResponseKind::Touch);
      blocked += mine.reached ? 0 : 1;
      EXPECT_EQ(mine.reached, other.reached) << "step " << k;
      // Depths are bounded to within a share of the tolerance, which a slanted motion takes long for.
      if (!has_ghosts) continue;
      EXPECT_LE(length(mine.pose.position - other.pose.position), kTolerance) << "step " << k;
      ++with_ghosts;
    }
  }
  EXPECT_GT(blocked, 80);
  EXPECT_GT(overlapping, 5);
  EXPECT_GT(with_ghosts, 80);
}

}  // namespace
}  // namespace dismantle
