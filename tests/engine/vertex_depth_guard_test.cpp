// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/vertex_depth_guard.h"

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/engine/classify_pairs.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {
namespace {

using scenes::component;
using scenes::tube;

constexpr double kTolerance = 0.01;

/// A pin 0.2 mm too thick for its bore, both with finer meshes: no triangle pair can be deeper than a triangle's size.
Assembly fine_press_fit() {
  return scenes::assembly(
      {component("pin", tube(2, 0, -1, 5, 100, 50)), component("bush", tube(4, 1.8, 0, 4, 100, 36))});
}

PairStates states_of(const Assembly& assembly) {
  ClassifyOptions options;
  options.tolerance = kTolerance;
  return *classify_pairs(assembly, options);
}

/// The pairs that overlap as pairs that touch, with the allowances that they have: these the guard watches.
PairStates touching_states_of(const Assembly& assembly) {
  PairStates states = states_of(assembly);
  for (ComponentPair& pair : states.pairs) pair.state = PairState::Contact;
  return states;
}

std::vector<RigidTransform> pin_at(Vec3 position) {
  return {{{}, position}, {}};
}

TEST(VertexDepthGuard, LetsAPinPressedAgainstItsBoreSlideOut) {
  const Assembly assembly = fine_press_fit();
  const ComponentId pin(0);
  // Its speed depends on which corners lie in which facets, and so on the direction.
  double together = 0;
  for (const double angle : {0.0, 0.02, 0.05}) {
    CertificateEngine engine(assembly, states_of(assembly), {});
    engine.grab({&pin, 1});
    const Vec3 aside{2 * std::cos(angle), 2 * std::sin(angle), 0};
    double furthest_aside = 0;
    for (int k = 1; k <= 10; ++k) {
      const StepResult step = engine.step({aside + Vec3{0, 0, 0.5 * k}, {}}, ResponseKind::Slide);
      furthest_aside = std::max(furthest_aside, std::hypot(step.pose.position.x, step.pose.position.y));
    }
    EXPECT_GT(engine.poses()[0].position.z, 1) << "of 5 mm, pressed at " << angle;
    EXPECT_LT(furthest_aside, 2 * kTolerance);
    together += engine.poses()[0].position.z;
  }
  EXPECT_GT(together, 6) << "of 15 mm";
}

TEST(VertexDepthGuard, LetsAFinelyMeshedPressFitOutAlongItsAxis) {
  const Assembly assembly = fine_press_fit();
  const PairStates states = touching_states_of(assembly);
  VertexDepthGuard guard(assembly, states, solids_of(assembly, Executor()), Executor());
  ASSERT_FALSE(guard.watches_nothing());
  for (int k = 0; k < 12; ++k) {
    EXPECT_TRUE(guard.sweep(pin_at({0, 0, 0.5 * k}), pin_at({0, 0, 0.5 * (k + 1)})).empty()) << k;
    guard.commit();
  }
}

TEST(VertexDepthGuard, KeepsAPinOutOfTheWall) {
  const Assembly assembly = fine_press_fit();
  const PairStates states = touching_states_of(assembly);
  VertexDepthGuard guard(assembly, states, solids_of(assembly, Executor()), Executor());
  const std::vector<BlockingPair> contacts = guard.sweep(pin_at({0, 0, 0}), pin_at({2, 0, 0}));
  ASSERT_FALSE(contacts.empty());
  // 0.2 mm deep at the start; the deepest vertex may have twice the allowance.
  const double limit = 2 * states.pairs[0].allowed_depth;
  EXPECT_LE(2 * contacts[0].toi + 0.2, limit + 1e-3);
  EXPECT_GE(2 * contacts[0].toi + 0.2, limit - 0.01);
  EXPECT_EQ(contacts[0].a, ComponentId(0));
  EXPECT_EQ(contacts[0].b, ComponentId(1));
}

TEST(VertexDepthGuard, FindsAnIntrusionThatIsClearAtBothEnds) {
  const Assembly assembly = fine_press_fit();
  const PairStates states = touching_states_of(assembly);
  VertexDepthGuard guard(assembly, states, solids_of(assembly, Executor()), Executor());
  // From one side of the bush to the other in one sweep.
  EXPECT_FALSE(guard.sweep(pin_at({-10, 0, 0}), pin_at({10, 0, 0})).empty());
  EXPECT_TRUE(guard.sweep(pin_at({-10, 0, 20}), pin_at({10, 0, 20})).empty());
}

TEST(VertexDepthGuard, KeepsOnlyTheSlackOfCommittedSweeps) {
  const Assembly assembly = fine_press_fit();
  const PairStates states = touching_states_of(assembly);
  VertexDepthGuard guard(assembly, states, solids_of(assembly, Executor()), Executor());
  EXPECT_FALSE(guard.sweep(pin_at({0, 0, 0}), pin_at({2, 0, 0})).empty());
  EXPECT_TRUE(guard.sweep(pin_at({0, 0, 0}), pin_at({0, 0, 1})).empty());
  guard.commit();
  EXPECT_FALSE(guard.sweep(pin_at({0, 0, 1}), pin_at({2, 0, 1})).empty());
  guard.jump();
  EXPECT_FALSE(guard.sweep(pin_at({0, 0, 1}), pin_at({2, 0, 1})).empty());
}

TEST(VertexDepthGuard, LimitsVerticesOfCoarseFits) {
  // The bore's corners are 0.02 mm inside the pin from the start.
  const Assembly assembly =
      scenes::assembly({component("pin", tube(5, 0, -2, 22, 48)), component("plate", tube(20, 4.98, 0, 20, 48))});
  const PairStates states = touching_states_of(assembly);
  VertexDepthGuard guard(assembly, states, solids_of(assembly, Executor()), Executor());
  EXPECT_FALSE(guard.sweep(pin_at({0, 0, 0}), pin_at({0.2, 0, 0})).empty());
  EXPECT_TRUE(guard.sweep(pin_at({0, 0, 0}), pin_at({0, 0, 5})).empty());
}

TEST(VertexDepthGuard, WatchesNothingIfNothingOverlaps) {
  const Assembly assembly =
      scenes::assembly({component("pin", tube(5, 0, -2, 22, 48)), component("plate", tube(20, 5, 0, 20, 48))});
  ASSERT_EQ(states_of(assembly).pairs.at(0).state, PairState::Contact);
  EXPECT_TRUE(
      VertexDepthGuard(assembly, states_of(assembly), solids_of(assembly, Executor()), Executor()).watches_nothing());
}

/// A tube along z by formulas: an oracle independent of the guard.
struct TubeShape {
  double outer, inner, z0, z1;
  std::uint32_t sides;

  TriangleMesh mesh(std::uint32_t rings) const { return tube(outer, inner, z0, z1, sides, rings); }

  /// The depth of a point; 0 outside.
  double depth(Vec3 p) const {
    const double turn = 2 * std::acos(-1.0) / sides;
    double beside_outer = std::numeric_limits<double>::infinity(), beside_inner = beside_outer;
    bool in_outer = true, in_inner = inner > 0;
    for (std::uint32_t k = 0; k < sides; ++k) {
      const auto corner = [&](double radius, std::uint32_t i) {
        return Vec3{radius * std::cos(i * turn), radius * std::sin(i * turn), 0};
      };
      const auto beside = [&](double radius, bool& inside) {
        const Vec3 a = corner(radius, k), ab = corner(radius, k + 1) - a, ap = Vec3{p.x, p.y, 0} - a;
        inside = inside && cross(ab, ap).z > 0;
        return length(ap - std::clamp(dot(ap, ab) / dot(ab, ab), 0.0, 1.0) * ab);
      };
      beside_outer = std::min(beside_outer, beside(outer, in_outer));
      if (inner > 0) beside_inner = std::min(beside_inner, beside(inner, in_inner));
    }
    if (!in_outer || in_inner || p.z < z0 || p.z > z1) return 0;
    return std::min({beside_outer, beside_inner, p.z - z0, z1 - p.z});
  }
};

/// A pin in a bush, finer than their allowance, and the depth of each one's vertices in the other.
struct FineFit {
  TubeShape pin_shape{2, 0, -1.03, 5, 40}, bush_shape{2.8, 1.95, 0, 4, 32};
  TriangleMesh pin = pin_shape.mesh(12), bush = bush_shape.mesh(8);
  Assembly assembly = scenes::assembly({component("pin", pin), component("bush", bush)});
  PairStates states = touching_states_of(assembly);
  double limit = 2 * states.pairs.at(0).allowed_depth;

  double deepest(const Pose& pose) const {
    const RigidTransform there = transform_from_pose(pose), back = inverse(there);
    double deepest = 0;
    for (const Vec3& p : pin.vertices) deepest = std::max(deepest, bush_shape.depth(there * p));
    for (const Vec3& p : bush.vertices) deepest = std::max(deepest, pin_shape.depth(back * p));
    return deepest;
  }
  bool clear_of_each_other(const Pose& pose) const {
    double lowest = 100;
    for (const Vec3& p : pin.vertices) lowest = std::min(lowest, (transform_from_pose(pose) * p).z);
    return lowest > 4.1;
  }
};

std::vector<RigidTransform> states_at(const Pose& pin) {
  return {transform_from_pose(pin), {}};
}

TEST(VertexDepthGuard, KeepsEveryVertexWithinTheLimitOnRandomDrags) {
  const FineFit fit;
  const double resolution = 0.05 * kTolerance;
  std::size_t stops = 0, free = 0;
  for (const std::uint64_t seed : {1, 2}) {
    std::mt19937_64 random(seed);
    VertexDepthGuard guard(fit.assembly, fit.states, solids_of(fit.assembly, {}), {});
    Pose pose;
    for (int step = 0; step < 40; ++step) {
      const double much = std::pow(10.0, -static_cast<double>(random() % 4));
      Pose target = Pose{{0, 0, 0.15 * much * step}, {}} * scenes::random_pose(random, 0.3 * much, 0.1 * much) * pose;
      if (step % 20 == 19) {
        target = pose = {{0, 0, 0.3 * static_cast<double>(random() % 10)}, {}};
        guard.jump();
      }
      const bool apart = fit.clear_of_each_other(pose) && fit.clear_of_each_other(target);
      double part = 1;
      for (int tries = 0; tries < 4; ++tries) {
        const Pose next = pose_between(pose, target, part);
        const std::pair both{ComponentId(0), ComponentId(1)};
        const auto found = guard.sweep(states_at(pose), states_at(next), {&both, apart ? 0u : 1u});
        const double toi = found.empty() ? 1 : found[0].toi;
        for (int k = 0; k <= 4; ++k)
          ASSERT_LE(fit.deepest(pose_between(pose, next, toi * k / 4)), fit.limit) << "seed " << seed << " " << step;
        if (found.empty()) {
          guard.commit();
          pose = next;
          ++free;
          break;
        }
        // No false positive.
        ++stops;
        ASSERT_GE(fit.deepest(pose_between(pose, next, toi)), fit.limit - 1.01 * resolution) << seed << " " << step;
        part *= toi * 0.999;
      }
    }
  }
  EXPECT_GT(stops, 10u);
  EXPECT_GT(free, 50u);
}

TEST(VertexDepthGuard, WatchesAFitWhoseTrianglesEndWhereTheOthersBegin) {
  // The pin's rings lie in the planes of the bush's ends, so that no triangles intersect however far it is pushed
  // aside; and they are too large to be within the allowance.
  const Assembly assembly =
      scenes::assembly({component("pin", tube(2, 0, -1, 5, 60, 30)), component("bush", tube(2.8, 1.95, 0, 4, 48, 20))});
  const PairStates states = touching_states_of(assembly);
  VertexDepthGuard guard(assembly, states, solids_of(assembly, {}), {});
  EXPECT_FALSE(guard.sweep(pin_at({0, 0, 0}), pin_at({0.5, 0, 0})).empty());
}

TEST(VertexDepthGuard, FindsTheSameOnAllExecutors) {
  const FineFit fit;
  std::vector<std::vector<BlockingPair>> all;
  for (const Executor& executor : {Executor(), Executor(ExecutorKind::Threads, 3), Executor(ExecutorKind::Shuffled)}) {
    VertexDepthGuard guard(fit.assembly, fit.states, solids_of(fit.assembly, executor), executor);
    std::vector<BlockingPair> found;
    for (int k = 0; k < 20; ++k) {
      const auto at = [](int step) { return states_at({{0.002 * (step % 3), 0, 0.2 * step}, {}}); };
      ASSERT_TRUE(guard.sweep(at(k), at(k + 1)).empty());
      guard.commit();
      const auto wall = guard.sweep(at(k + 1), states_at({{1, 0, 0.2 * (k + 1)}, quat_about({1, 0, 0}, 0.1)}));
      found.insert(found.end(), wall.begin(), wall.end());
    }
    ASSERT_GE(found.size(), 20u);
    all.push_back(found);
  }
  for (const std::vector<BlockingPair>& other : all) {
    ASSERT_EQ(other.size(), all[0].size());
    for (std::size_t i = 0; i < other.size(); ++i) {
      EXPECT_EQ(other[i].toi, all[0][i].toi);
      EXPECT_EQ(other[i].face_a, all[0][i].face_a);
      EXPECT_EQ(other[i].face_b, all[0][i].face_b);
    }
  }
}

}  // namespace
}  // namespace dismantle
