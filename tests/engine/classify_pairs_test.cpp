// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/classify_pairs.h"

#include "dismantle/surface/surface_queries.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dismantle {
namespace {

using scenes::box;
using scenes::component;
using scenes::tube;

PairStates classified(const Assembly& assembly, double tolerance = 0.01, double clearance = 0,
                      ClassifyRule rule = ClassifyRule::Auto) {
  ClassifyOptions options;
  options.tolerance = tolerance;
  options.clearance = clearance;
  options.rule = rule;
  Result<PairStates> states = classify_pairs(assembly, options);
  EXPECT_TRUE(states.ok());
  return *states;
}

Assembly two(TriangleMesh a, TriangleMesh b) {
  return scenes::assembly({component("a", std::move(a)), component("b", std::move(b))});
}

TEST(ClassifyPairs, ListsNothingIfAllIsFarApart) {
  EXPECT_TRUE(classified(two(box({0, 0, 0}, {1, 1, 1}), box({3, 0, 0}, {4, 1, 1}))).pairs.empty());
}

TEST(ClassifyPairs, CallsExactlyTouchingFacesContact) {
  const PairStates states = classified(two(box({0, 0, 0}, {1, 1, 1}), box({1, 0.25, 0.25}, {2, 0.75, 0.75})));
  ASSERT_EQ(states.pairs.size(), 1u);
  EXPECT_EQ(states.pairs[0].state, PairState::Contact);
  EXPECT_LE(states.pairs[0].depth, 0.001);  // an upper bound, within a tenth of the tolerance
  EXPECT_EQ(states.pairs[0].distance, 0);
  EXPECT_DOUBLE_EQ(states.pairs[0].allowed_depth, 0.01);
}

TEST(ClassifyPairs, CallsAGapWithinToleranceContactAndOneWithinClearanceNear) {
  const Assembly assembly = two(box({0, 0, 0}, {1, 1, 1}), box({1.005, 0, 0}, {2, 1, 1}));
  EXPECT_EQ(classified(assembly, 0.01).pairs.at(0).state, PairState::Contact);
  EXPECT_NEAR(classified(assembly, 0.01).pairs.at(0).distance, 0.005, 1e-12);
  EXPECT_EQ(classified(assembly, 0.001, 0.1).pairs.at(0).state, PairState::Near);
  EXPECT_NEAR(classified(assembly, 0.001, 0.1).pairs.at(0).distance, 0.005, 1e-12);
  EXPECT_TRUE(classified(assembly, 0.001).pairs.empty());
}

TEST(ClassifyPairs, AllowsContactWithDepthItsDepthAndTheTolerance) {
  const PairStates states = classified(two(box({0, 0, 0}, {1, 1, 1}), box({0.994, 0.25, 0.25}, {2, 0.75, 0.75})));
  ASSERT_EQ(states.pairs.size(), 1u);
  EXPECT_EQ(states.pairs[0].state, PairState::Contact);
  EXPECT_NEAR(states.pairs[0].allowed_depth, 0.016, 0.001);
}

TEST(DeclareAllowances, RaisesAllowancesOfPairsThatTouchOrOverlap) {
  const Assembly assembly = two(box({0, 0, 0}, {1, 1, 1}), box({0.9, 0.25, 0.25}, {2, 0.75, 0.75}));
  PairStates states = classified(assembly);
  const std::vector<DeclaredAllowance> declared{{"b", "a", 0.3}};
  ASSERT_TRUE(declare_allowances(states, assembly, declared).ok());
  EXPECT_EQ(states.pairs[0].allowed_depth, 0.3);
  EXPECT_EQ(states.pairs[0].declared, 0.3);
  // Not below what the pair has anyway.
  PairStates same = classified(assembly);
  const std::vector<DeclaredAllowance> less{{"a", "b", 0.05}};
  ASSERT_TRUE(declare_allowances(same, assembly, less).ok());
  EXPECT_EQ(same.pairs, classified(assembly).pairs);
}

TEST(DeclareAllowances, RefusesUnknownComponentsAndPairsThatAreApart) {
  const Assembly assembly = two(box({0, 0, 0}, {1, 1, 1}), box({1.5, 0, 0}, {2, 1, 1}));
  for (const char* other : {"b", "c", "a"}) {
    PairStates states = classified(assembly, 0.01, 1);
    const std::vector<DeclaredAllowance> declared{{"a", other, 0.3}};
    const Result<Done> result = declare_allowances(states, assembly, declared);
    ASSERT_FALSE(result.ok()) << other;
    EXPECT_EQ(result.error().kind, ErrorKind::Usage);
  }
}

TEST(ClassifyPairs, TakesTheToleranceAndTheAllowancesOfItsOptions) {
  const Assembly touching = two(box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1}));
  ClassifyOptions options;
  options.tolerance = 0.02;
  options.declared = {{"a", "b", 0.3}};
  const Result<PairStates> states = classify_pairs(touching, options);
  ASSERT_TRUE(states.ok());
  EXPECT_EQ(states->tolerance, 0.02);
  EXPECT_EQ(states->pairs.at(0).allowed_depth, 0.3);
  options.declared = {{"a", "c", 0.3}};
  EXPECT_FALSE(classify_pairs(touching, options).ok());
}

TEST(ClassifyPairs, CallsAPressedPinOverlappingAndAllowsItsDepthAndTheTolerance) {
  const PairStates states = classified(two(tube(5, 0, -2, 22, 64), tube(9, 4.95, 0, 20, 64)));
  ASSERT_EQ(states.pairs.size(), 1u);
  const ComponentPair& pair = states.pairs[0];
  EXPECT_EQ(pair.state, PairState::Overlapping);
  EXPECT_NEAR(pair.depth, 0.05, 0.002);
  EXPECT_DOUBLE_EQ(pair.allowed_depth, pair.depth + 0.01);
}

TEST(ClassifyPairs, TreatsADeepOverlapLikeAShallowOne) {
  const PairStates states = classified(two(tube(5, 0, -2, 22, 64), tube(9, 3, 0, 20, 64)));
  ASSERT_EQ(states.pairs.size(), 1u);
  EXPECT_EQ(states.pairs[0].state, PairState::Overlapping);
  EXPECT_NEAR(states.pairs[0].allowed_depth, 2.01, 0.03);
}

TEST(ClassifyPairs, GivesASolidInsideAnotherTheDepthOfItsDeepestPoint) {
  const PairStates states = classified(two(box({0, 0, 0}, {10, 10, 10}), box({4, 4, 4}, {6, 6, 6})));
  ASSERT_EQ(states.pairs.size(), 1u);
  EXPECT_EQ(states.pairs[0].state, PairState::Overlapping);
  EXPECT_GE(states.pairs[0].depth, 4);
  EXPECT_LE(states.pairs[0].depth, 4.04);
}

TEST(ClassifyPairs, ListsNoPairForASolidInACavity) {
  TriangleMesh shell = box({0, 0, 0}, {10, 10, 10});
  TriangleMesh cavity = box({2, 2, 2}, {8, 8, 8});
  for (Face f : cavity.faces) {
    std::swap(f.v[1], f.v[2]);
    shell.faces.push_back({{f.v[0] + 8, f.v[1] + 8, f.v[2] + 8}});
  }
  shell.vertices.insert(shell.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
  EXPECT_TRUE(classified(two(shell, box({4, 4, 4}, {6, 6, 6}))).pairs.empty());
}

TEST(ClassifyPairs, MakesEveryPairThatTouchesFreeByThePapersRule) {
  const Assembly touching = two(box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1}));
  const PairStates states = classified(touching, 0.01, 0, ClassifyRule::Paper);
  EXPECT_EQ(states.pairs.at(0).state, PairState::Free);
  EXPECT_TRUE(std::isinf(states.pairs[0].allowed_depth));
}

TEST(ClassifyPairs, FindsDeepVerticesThatFineTrianglesHide) {
  // A finely tessellated pin 0.2 mm too thick: no triangle of it is deeper than its own size, but its vertices are.
  const PairStates states = classified(two(tube(5, 0, 1, 19, 160, 160), tube(9, 4.8, 0, 20, 160, 160)));
  ASSERT_EQ(states.pairs.size(), 1u);
  EXPECT_GE(states.pairs[0].depth, 0.199);
}

TEST(ClassifyPairs, GivesTheSameForEveryThreadCount) {
  std::vector<Component> parts;
  for (int i = 0; i < 6; ++i)
    parts.push_back(
        component("t" + std::to_string(i), scenes::moved(tube(5, 4, 0, 10, 48, 4), {{3.0 * i, 0.1 * i, 0}, {}})));
  const Assembly assembly = scenes::assembly(std::move(parts));
  const PairStates expected = classified(assembly);
  EXPECT_GE(expected.pairs.size(), 5u);
  for (const int threads : {1, 2, 7}) {
    ClassifyOptions options;
    options.tolerance = 0.01;
    options.executor = Executor(ExecutorKind::Threads, threads);
    EXPECT_EQ(classify_pairs(assembly, options)->pairs, expected.pairs);
  }
}

TEST(ClassifyPairs, StopsWhenCancelled) {
  ClassifyOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_FALSE(classify_pairs(two(box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})), options).ok());
}

TEST(SurfaceQueries, GiveTheSideAndTheDistanceOfAPoint) {
  const Assembly assembly = scenes::assembly({component("tube", tube(9, 5, 0, 20, 64, 8))});
  const AssemblySurface surface = make_assembly_surface(assembly, Executor());
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> across(-12, 12), along(-3, 23);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p{across(random), across(random), along(random)};
    const double r = std::hypot(p.x, p.y);
    const double depth = std::min({9 - r, r - 5, p.z, 20 - p.z});  // of the smooth tube
    if (std::abs(depth) < 0.05) continue;                          // the facets' sagitta is below this
    EXPECT_EQ(point_in_component(surface.assembled(), p, ComponentId(0)), depth > 0) << p.x << " " << p.y << " " << p.z;
    if (depth > 0) {
      EXPECT_NEAR(surface_distance(surface, ComponentId(0), p), depth, 0.05);
    }
  }
}

}  // namespace
}  // namespace dismantle
