// SPDX-License-Identifier: Apache-2.0
// The guards of pairs that overlap in the assembled state (docs/design/0012-ghost-surfaces.md).
#include "dismantle/certificates/ghosts/find_guards.h"

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/certificates/sweep/assembly_surfaces.h"
#include "tests/certificates/grabbed_component.h"
#include "tests/support/depth_oracle.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/large_scenes.h"
#include "tests/support/puzzle_scenes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/swept_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dismantle {
namespace {

using namespace grabbed;

std::vector<FoundGuard> guards_of(const Assembly& assembly, const PairStates& states) {
  const Executor executor;
  const AssemblySurfaces surfaces(assembly, {states.tolerance, {}});
  std::vector<ComponentTrees> trees;
  for (std::uint32_t c = 0; c < assembly.components.size(); ++c)
    trees.push_back({&surfaces.solid(ComponentId(c)), &surfaces.ghost(ComponentId(c))});
  const LazyShapes shapes(assembly);
  return find_guards({&assembly, &states, &shapes, trees, executor, front_kernels(CertificateOptions{}.lanes)});
}

TEST(FindGuards, FindsGhostsOfFineCylindersThatTouchEverywhere) {
  const scenes::SlideScene scene = scenes::shaft_in_hole(120000, 0);
  const PairStates states{kTolerance, {{ComponentId(0), ComponentId(1), PairState::Contact, 0, 0, kTolerance}}};
  for (const FoundGuard& found : guards_of(scene.assembly, states)) EXPECT_EQ(found.guard.guard, PairGuard::Ghosts);
}

/// The mesh leaning along x.
TriangleMesh leaning(TriangleMesh mesh, double by) {
  for (Vec3& p : mesh.vertices) p.x += by * p.z;
  return mesh;
}

/// A rod that fills an oblique hole of a disk, and is larger.
Assembly rod_in_oblique_hole(double larger = 0.5, double lean = 1) {
  return scenes::assembly({scenes::component("rod", leaning(scenes::tube(2.5 + larger, 0, -4, 26, 24), lean)),
                           scenes::component("disk", leaning(scenes::tube(12, 2.5, 0, 20, 24), lean))});
}

TEST(FindGuards, FindsGhostsAroundTheMouthsOfObliqueHoles) {
  const Assembly assembly = rod_in_oblique_hole();
  const PairStates states = states_of(assembly);
  const std::vector<FoundGuard> guards = guards_of(assembly, states);
  ASSERT_EQ(guards.size(), 1u);
  EXPECT_EQ(guards[0].guard.guard, PairGuard::Ghosts);
  EXPECT_FALSE(guards[0].ghosts[0].empty());
}

TEST(FindGuards, LetARodOutOfAnObliqueHoleAlongItsAxisOnly) {
  const Assembly assembly = rod_in_oblique_hole();
  const PairStates states = states_of(assembly);
  const double start = oracle::sampled_depth(*assembly.components[0].mesh, *assembly.components[1].mesh, 1).depth;
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}) {
    Grabbed out(assembly, states, 0), aside(assembly, states, 0);
    for (int k = 1; k <= 16; ++k)
      EXPECT_TRUE(out.engine.step({{-2.0 * k, 0, -2.0 * k}, {}}, response).reached) << "step " << k;
    for (int k = 1; k <= 3; ++k) {
      const Pose pose = aside.engine.step({{0, 0.2 * k, 0}, {}}, response).pose;
      EXPECT_LE(pose.position.y, 2.5 * kTolerance);
      const TriangleMesh rod = scenes::moved(*assembly.components[0].mesh, pose);
      EXPECT_LE(oracle::sampled_depth(rod, *assembly.components[1].mesh, 2).depth, start + 1.1 * kTolerance);
    }
  }
}

TEST(FindGuards, LetARodThroughAFlangeWithoutAHoleMoveAlongItsAxisOnly) {
  const Assembly assembly = rod_through_flange();
  const PairStates states = states_of(assembly);
  const std::vector<FoundGuard> guards = guards_of(assembly, states);
  ASSERT_EQ(guards.size(), 1u);
  EXPECT_EQ(guards[0].guard.guard, PairGuard::Depth);
  EXPECT_TRUE(guards[0].guard.hole_for[0]) << "the flange could have a hole";
  EXPECT_FALSE(guards[0].guard.hole_for[1]) << "the rod would be cut in two";
  for (const std::uint32_t moving : {0u, 1u}) {
    const double sign = moving == 0 ? 1 : -1;
    Grabbed out(assembly, states, moving);
    for (int k = 1; k <= 6; ++k)
      EXPECT_TRUE(out.engine.step({{0, sign * 2 * k, 0}, {}}, ResponseKind::Stop).reached) << k;
    Grabbed in(assembly, states, moving);
    EXPECT_NEAR(in.engine.step({{0, -sign * 6, 0}, {}}, ResponseKind::Touch).pose.position.y, -sign * 4, 1.1);
    for (const Vec3 way : {Vec3{-1, 0, 0}, {0, 0, 1}, {0.6, 0, -0.8}}) {
      Grabbed aside(assembly, states, moving);
      Pose pose;
      for (int k = 1; k <= 12; ++k) pose = aside.engine.step({0.5 * k * way, {}}, ResponseKind::Touch).pose;
      EXPECT_LE(length(pose.position), 0.5 + 2.5 * kTolerance) << way.x << " " << way.z;
    }
  }
}

/// The greatest depth of sampled points of a component's faces on their straight way to their displaced places.
double deepest_on_the_way(const TriangleMesh& mesh, const std::vector<Vec3>& displaced) {
  double deepest = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    for (const double share : {0.3, 0.7, 1.0}) {
      Triangle now;
      for (int i = 0; i < 3; ++i) now[i] = (1 - share) * t[i] + share * displaced[mesh.faces[f].v[i]];
      oracle::for_each_sample(now[0], now[1], now[2], 2, [&](Vec3 p) {
        if (std::abs(oracle::winding_number(mesh, p)) > 0.5) deepest = std::max(deepest, oracle::distance(mesh, p));
      });
    }
  }
  return deepest;
}

TEST(FindGuards, NoGhostIsDeeperInItsSolidThanThePairMayBe) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(0, 1);
  int ghosts = 0;
  for (int i = 0; i < 36; ++i) {
    // A corner, an edge or a rod that is a little inside a box.
    const Vec3 size{1 + 2 * u(random), 1 + 2 * u(random), 1 + 2 * u(random)};
    TriangleMesh part = i % 2 == 0
                            ? scenes::box(-1.0 * size, size)
                            : scenes::tube(1 + u(random), 0, -2, 2, 3 + static_cast<std::uint32_t>(9 * u(random)));
    const RigidTransform tilt = transform_from_pose(scenes::random_pose(random, 0.5, 3));
    double lowest = 0;
    for (Vec3& p : part.vertices) lowest = std::min(lowest, (p = tilt * p).z);
    const double depth = i % 3 == 0 ? 0.02 + 0.1 * u(random) : 0.1 + 0.8 * u(random);
    for (Vec3& p : part.vertices) p.z += -lowest - depth;
    TriangleMesh block = scenes::box({-4, -4, -4}, {4, 4, 0});
    if (i % 5 == 0) block = scenes::box({-4, -4, -4}, {0.4, 0.3, 0});  // at its corner
    const Assembly assembly = i % 6 == 1 ? rod_in_oblique_hole(0.1 + 0.6 * u(random), 0.2 + u(random))
                                         : scenes::assembly({scenes::component("part", std::move(part)),
                                                             scenes::component("block", std::move(block))});
    const PairStates states = states_of(assembly);
    for (const FoundGuard& found : guards_of(assembly, states)) {
      if (found.guard.guard != PairGuard::Ghosts) continue;
      ++ghosts;
      for (int side = 0; side < 2; ++side) {
        const TriangleMesh& mesh = *assembly.components[static_cast<std::size_t>(side)].mesh;
        const std::vector<Vec3>& displaced = found.ghosts[static_cast<std::size_t>(side)];
        const double most = found.guard.allowed - kArcShare * kTolerance;
        EXPECT_LE(deepest_on_the_way(mesh, displaced), most) << "scene " << i << " side " << side;
      }
    }
  }
  EXPECT_GE(ghosts, 20);
}

/// A block at some height over the upper face of a floor; both with the ghosts that they have against all others.
struct BlockOverFloor {
  Assembly assembly = scenes::assembly({scenes::component("block", scenes::box({0, 0, 0}, {5, 5, 5})),
                                        scenes::component("floor", scenes::box({-20, -20, -9}, {20, 20, 0}))});
  AssemblySurfaces surfaces{assembly, {kTolerance, {}}};
  SolidShape shapes[2] = {SolidShape(assembly.components[0]), SolidShape(assembly.components[1])};
  ComponentAt at(std::uint32_t c, double height = 0) {
    const ComponentId id(c);
    return {&surfaces.solid(id), &surfaces.ghost(id), {{}, {0, 0, height}}, [this, c] { return &shapes[c]; }};
  }
};

TEST(UsualGhosts, MeetWhereTwoOverlapByMoreThanTheirFacesAreRetracted) {
  BlockOverFloor scene;
  const double retracted = kGhostLength * kTolerance / std::sqrt(3.0);  // all vertices are corners of boxes
  for (const auto& [height, apart] :
       {std::pair(1.0, true), {0.0, true}, {-0.9, true}, {-1.1, false}, {-300.0, false}}) {
    EXPECT_EQ(usual_ghosts_apart(scene.at(0, height * retracted), scene.at(1), kTolerance), apart) << height;
    EXPECT_EQ(usual_ghosts_apart(scene.at(1), scene.at(0, height * retracted), kTolerance), apart) << height;
  }
}

TEST(FurtherApart, IsTrueOutsideOfEachOtherAndFromThatDistanceOn) {
  BlockOverFloor scene;
  const auto apart = [&](double height, double distance) {
    const bool result = further_apart(scene.at(0, height), scene.at(1), distance);
    EXPECT_EQ(further_apart(scene.at(1), scene.at(0, height), distance), result) << height << " " << distance;
    return result;
  };
  for (const double distance : {0.001, 0.1, 3.0}) {
    EXPECT_TRUE(apart(1.01 * distance, distance));
    EXPECT_TRUE(apart(1.99 * distance, distance));
    EXPECT_TRUE(apart(50 * distance + 50, distance));
    EXPECT_FALSE(apart(0.99 * distance, distance));
    EXPECT_FALSE(apart(0, distance));
    EXPECT_FALSE(apart(-1, distance));
    EXPECT_FALSE(apart(-7, distance)) << "within the floor, 2 mm from its faces";
  }
}

/// none_inside() of two components, either way round.
bool none_inside_of(TriangleMesh first, Component second) {
  const Assembly assembly = scenes::assembly({scenes::component("first", std::move(first)), std::move(second)});
  const AssemblySurfaces surfaces(assembly, {kTolerance, {}});
  const SolidShape shapes[] = {SolidShape(assembly.components[0]), SolidShape(assembly.components[1])};
  const auto at = [&](std::uint32_t c) {
    const ComponentId id(c);
    return ComponentAt{&surfaces.solid(id), &surfaces.ghost(id), {}, [&shapes, c] { return &shapes[c]; }};
  };
  EXPECT_EQ(none_inside(at(0), at(1)), none_inside(at(1), at(0)));
  return none_inside(at(0), at(1));
}

TEST(NoneInside, LooksAtEachShellAndAtEveryVertexWhereTheOtherOneIsOpen) {
  const TriangleMesh box = scenes::box({-2, -2, -2}, {2, 2, 2});
  // Two discs as one component, of which the second may be within a box, in its wall, or outside.
  const auto none_inside_at = [](Vec3 at, const TriangleMesh& second) {
    TriangleMesh discs = scenes::tube(0.2, 0, -30, -29, 12);
    discs = scenes::joined(std::move(discs), scenes::moved(scenes::tube(0.2, 0, -0.2, 0.2, 12), {at, {}}));
    EXPECT_EQ(SolidShape(scenes::component("discs", discs)).shell_points().size(), 2u);
    return none_inside_of(std::move(discs), scenes::component("box", second));
  };
  for (const TriangleMesh& second : {box, scenes::without_face(box, 11), scenes::with_t_junction(box, 3)}) {
    EXPECT_FALSE(none_inside_at({}, second));
    EXPECT_FALSE(none_inside_at({0.5, -0.5, 0.5}, second));
    EXPECT_TRUE(none_inside_at({0, 0, 5}, second));
    EXPECT_TRUE(none_inside_at({-2.5, 2.5, 0}, second));
  }
}

TEST(NoneInside, FindsWhatReachesInThroughAHole) {
  const TriangleMesh box = scenes::box({-2, -2, -2}, {2, 2, 2});
  for (std::size_t face = 0; face < box.faces.size(); ++face) {
    const Component open = scenes::component("box", scenes::without_face(box, face));
    const Face& f = box.faces[face];
    const Vec3 center = (box.vertices[f.v[0]] + box.vertices[f.v[1]] + box.vertices[f.v[2]]) / 3;
    const Vec3 out = normalized(cross(box.vertices[f.v[1]] - box.vertices[f.v[0]], box.vertices[f.v[2]] - center));
    const auto rod = [&](double from, double to) {
      Aabb bounds;
      for (const double along : {from, to}) bounds.extend(center + along * out);
      return scenes::box(bounds.lower - Vec3{0.1, 0.1, 0.1}, bounds.upper + Vec3{0.1, 0.1, 0.1});
    };
    EXPECT_FALSE(none_inside_of(rod(-1.5, 5), open)) << face;
    EXPECT_TRUE(none_inside_of(rod(1, 5), open)) << face;
  }
}

TEST(FindGuards, BoundsDepthsByTheStartAndTheToleranceLessWhatArcsTake) {
  // Rods that cross, and have no ghosts.
  const TriangleMesh rod = scenes::tube(1, 0, -10, 10, 12);
  const Assembly assembly = scenes::assembly(
      {scenes::component("rod", rod),
       scenes::component("across", scenes::moved(rod, {{0.2, 0, 0}, quat_about({1, 0, 0}, kTurn / 4)}))});
  const PairStates states = states_of(assembly);
  const std::vector<FoundGuard> guards = guards_of(assembly, states);
  ASSERT_EQ(guards.size(), 1u);
  const GuardedPair& guard = guards[0].guard;
  EXPECT_EQ(guard.guard, PairGuard::Depth);
  EXPECT_LE(guard.allowed, states.pairs[0].depth + kTolerance * (1 + 1e-9));
  for (const bool a_first : {false, true}) {
    const DepthLimits limits = depth_limits(guard, a_first, kTolerance);
    EXPECT_LE(limits.limit + kArcShare * kTolerance, guard.allowed * (1 + 1e-9));
    EXPECT_LE(std::max(limits.far_a, limits.far_b) + kArcShare * kTolerance, kTolerance * (1 + 1e-9))
        << "as deep as a rod is thick: all other points get no deeper than the tolerance";
  }
}

}  // namespace
}  // namespace dismantle
