// SPDX-License-Identifier: Apache-2.0
// Ghost surfaces of components that engage about a common axis, and are drawn into each other there.
#include "dismantle/certificates/ghosts/coaxial_ghost.h"

#include "dismantle/certificates/ghosts/profile_along_axis.h"
#include "dismantle/certificates/sweep/assembly_surfaces.h"
#include "dismantle/surface/ghost_surface.h"
#include "tests/certificates/grabbed_component.h"
#include "tests/support/depth_oracle.h"
#include "tests/support/large_scenes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/swept_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {
namespace {

using namespace grabbed;

/// Part of a profile with rings in place of a thread, every 2 mm, crests 0.6 mm wide. @param height below 0 for a bore
scenes::Profile rings(double radius, double height, double begin, double end) {
  scenes::Profile profile;
  for (double z = begin; z + 2 <= end; z += 2)
    for (const scenes::ProfilePoint p : {scenes::ProfilePoint{radius, z + 0.2},
                                         {radius + height, z + 0.7},
                                         {radius + height, z + 1.3},
                                         {radius, z + 1.8}})
      profile.push_back(p);
  return profile;
}

/// A ringed rod in a ringed nut, crest on crest: a nut that is drawn half a pitch off its screw.
Assembly nut_off_its_screw(std::uint32_t rod_sides, std::uint32_t nut_sides) {
  scenes::Profile rod{{0, -10}, {7, -10}};
  for (const auto& p : rings(7, 1, -10, 24)) rod.push_back(p);
  rod.push_back({7, 24.5});
  rod.push_back({0, 24.5});
  scenes::Profile nut{{7.9, 0}};
  for (const auto& p : rings(7.9, -0.9, 0, 12)) nut.push_back(p);
  nut.push_back({7.9, 12});
  nut.push_back({13, 12});
  nut.push_back({13, 0});
  std::reverse(nut.begin(), nut.end());  // counter-clockwise
  return scenes::assembly({scenes::component("rod", scenes::revolved(rod, rod_sides)),
                           scenes::component("nut", scenes::revolved_loop(nut, nut_sides))});
}

TEST(CoaxialGhost, LetsANutThatIsDrawnOffItsScrewOutAlongTheAxisOnly) {
  for (const auto& [rod_sides, nut_sides] : {std::pair{36u, 36u}, {40u, 28u}}) {
    SCOPED_TRACE(rod_sides);
    const Assembly assembly = nut_off_its_screw(rod_sides, nut_sides);
    const PairStates states = states_of(assembly);
    ASSERT_EQ(states.pairs.size(), 1u);
    const double start = states.pairs[0].depth;
    ASSERT_GT(start, 0.5);
    Grabbed nut(assembly, states, 1);
    EXPECT_TRUE(nut.engine.first_contact({{0, 0, 40}, {}}).free);
    EXPECT_TRUE(nut.engine.first_contact({{0, 0, -40}, {}}).free);
    // Across the axis it has the play of what it may overlap, and no more.
    const Pose aside = nut.engine.step({{3, 0, 0}, {}}, ResponseKind::Touch).pose;
    const TriangleMesh moved = scenes::moved(*assembly.components[1].mesh, aside);
    EXPECT_LE(oracle::sampled_depth(moved, *assembly.components[0].mesh, 1).depth, start + 1.1 * kTolerance);
    EXPECT_LT(aside.position.x, 1.5);
  }
}

/// A nut on a bolt, with threads that are 0.03 mm too wide for each other. Below `z` the grooves of the bolt end at
/// `radius`, as in a run-out: there the nut's thread is deeper in it.
Assembly nut_at_a_run_out(double z, double radius) {
  const scenes::SlideScene scene = scenes::bolt_in_nut(24000, -0.03);
  TriangleMesh bolt = *scene.assembly.components[1].mesh;
  for (Vec3& p : bolt.vertices) {
    const double r = std::hypot(p.x, p.y);
    if (r == 0 || r >= radius || p.z >= z) continue;
    p.x *= radius / r;
    p.y *= radius / r;
  }
  return scenes::assembly({scene.assembly.components[0], scenes::component("bolt", bolt)});
}

TEST(CoaxialGhost, HoldsANutByTheRestOfItsThreadWhereItIsDeepInTheRunOut) {
  for (const auto& [z, radius] : {std::pair{3.0, 4.0}, {1.5, 4.2}, {0.7, 4.1}}) {
    SCOPED_TRACE(radius);
    const Assembly assembly = nut_at_a_run_out(z, radius);
    const PairStates states = states_of(assembly);
    ASSERT_EQ(states.pairs.size(), 1u);
    ASSERT_GT(states.pairs[0].depth, 0.3);
    Grabbed bolt(assembly, states, 1);
    const auto expect_held = [&](double angle) {
      for (const double away : {40.0, -40.0}) {
        const Pose from = scenes::unscrewed(angle);
        const Pose target{from.position + Vec3{0, 0, away}, from.rotation};
        const Pose along = bolt.engine.step(target, ResponseKind::Touch).pose;
        EXPECT_LT(std::abs(along.position.z - from.position.z), 0.1) << away;
        bolt.engine.step(from, ResponseKind::Touch);
        EXPECT_EQ(bolt.engine.poses()[1], from);
      }
    };
    expect_held(0);
    for (int k = 1; k <= 10; ++k) EXPECT_TRUE(bolt.engine.step(scenes::unscrewed(-k), ResponseKind::Touch).reached);
    expect_held(-10);
  }
}

TEST(CoaxialGhost, KeepsTheThreadsThatMate) {
  const Assembly assembly = nut_at_a_run_out(3, 4);
  const AssemblySurfaces surfaces(assembly, states_of(assembly));
  const PairKey pair{ComponentId(0), ComponentId(1)};
  ASSERT_NE(surfaces.own_ghosts(pair), nullptr);
  EXPECT_EQ(surfaces.own_threads({pair, GhostOf::First}).size(), 1u);
  EXPECT_EQ(surfaces.own_threads({pair, GhostOf::Second}).size(), 1u);
}

TEST(CoaxialGhost, IsNoDeeperInItsSolidThanAllowed) {
  const Assembly assembly = nut_off_its_screw(36, 30);
  const PairStates states = states_of(assembly);
  const Executor executor;
  const AssemblySurfaces surfaces(assembly, {states.tolerance, {}});
  const SolidShape shapes[] = {SolidShape(assembly.components[0]), SolidShape(assembly.components[1])};
  const double limit = states.pairs[0].depth;
  for (const std::uint32_t own : {0u, 1u}) {
    const auto side = [&](std::uint32_t c) {
      return OverlapSide{&surfaces.solid(ComponentId(c)), [&, c]() -> const SolidShape& { return shapes[c]; }};
    };
    const OverlapSide mine = side(own), other = side(1 - own);
    const auto axes = common_axes(*mine.tree, *other.tree, 0.01);
    ASSERT_EQ(axes.size(), 1u);
    EXPECT_NEAR(std::abs(axes[0].direction.z), 1, 1e-9);
    std::size_t moved = 0, tried = 0;
    const auto good = [&](const std::vector<Vec3>& vertices) {
      ++tried;
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        const Vec3 before = mine.tree->vertices[v];
        EXPECT_LE(length(vertices[v] - before), 2 * limit);
        if (vertices[v] == before) continue;
        ++moved;
        EXPECT_NEAR(vertices[v].z, before.z, 1e-12);
        EXPECT_LE(oracle::distance(*assembly.components[own].mesh, vertices[v]), limit + 1e-9);
        EXPECT_EQ(length(Vec3{vertices[v].x, vertices[v].y, 0}) > length(Vec3{before.x, before.y, 0}), own == 1);
      }
      return tried == 2;
    };
    const RetractableSurface surface(mine.tree->vertices, mine.tree->faces);
    EXPECT_TRUE(
        coaxial_ghost({&mine, &other, &surface, axes[0], mine.tree->vertices, 2 * limit, limit, {0.05, 0.001}}, good));
    EXPECT_GT(moved, 100u);
  }
}

TEST(CoaxialGhost, OpensNoCrackBetweenFacesThatShareNoVertices) {
  // As STL files have it: each face has vertices of its own.
  const Assembly assembly = nut_off_its_screw(24, 24);
  const TriangleMesh whole = *assembly.components[0].mesh;
  TriangleMesh loose;
  for (std::uint32_t f = 0; f < whole.faces.size(); ++f) {
    const auto at = static_cast<std::uint32_t>(loose.vertices.size());
    for (int i = 0; i < 3; ++i) loose.vertices.push_back(whole.triangle(f)[i]);
    loose.faces.push_back({{at, at + 1, at + 2}});
  }
  const SolidTree rod = make_solid_tree(assembly.components[0], {}), nut = make_solid_tree(assembly.components[1], {});
  const Component component = scenes::component("loose", loose);
  const SolidTree tree = make_solid_tree(component, {});
  const SolidShape rod_shape(assembly.components[0]), nut_shape(assembly.components[1]);
  const OverlapSide own{&tree, [&]() -> const SolidShape& { return rod_shape; }};
  const OverlapSide other{&nut, [&]() -> const SolidShape& { return nut_shape; }};
  const auto axes = common_axes(rod, nut, 0.01);
  ASSERT_FALSE(axes.empty());
  const RetractableSurface surface(tree.vertices, tree.faces);
  const auto found = coaxial_ghost({&own, &other, &surface, axes[0], tree.vertices, 2, 1, {0.01}},
                                   [](const std::vector<Vec3>&) { return true; });
  ASSERT_TRUE(found);
  const std::vector<std::uint32_t> first = first_at_position(tree.vertices);
  std::size_t moved = 0;
  for (std::size_t v = 0; v < found->size(); ++v) {
    EXPECT_EQ((*found)[v], (*found)[first[v]]);
    moved += (*found)[v] != tree.vertices[v];
  }
  EXPECT_GT(moved, 100u);
}

TEST(ProfileAlongAxis, IsTheNearestAndTheFarthestOfRandomFaces) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  const AxisFrame axis({u(random), u(random), u(random)}, normalized(Vec3{u(random), u(random), u(random)}));
  std::vector<Triangle> faces;
  for (int i = 0; i < 40; ++i) {
    // Away from the axis, so that none is around it.
    const double angle = kTurn * u(random);
    Triangle t;
    for (int k = 0; k < 3; ++k)
      t[k] = axis.point + (5 + u(random)) * axis.at(angle + 0.4 * u(random)) + 3 * u(random) * axis.direction;
    faces.push_back(t);
  }
  for (const bool farthest : {false, true}) {
    const ProfileAlongAxis profile(axis, faces, farthest);
    // Points of the faces are within the outline at their angle, and some are on it.
    double nearest_to_outline = std::numeric_limits<double>::infinity();
    for (const Triangle& t : faces)
      for (int i = 0; i < 400; ++i) {
        const double a = std::abs(u(random)), b = (1 - a) * std::abs(u(random));
        const Vec3 across = axis.across(t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]));
        const std::optional<double> outline = profile.distance(axis.angle(across));
        ASSERT_TRUE(outline);
        const double within = farthest ? *outline - length(across) : length(across) - *outline;
        EXPECT_GE(within, -1e-9);
        nearest_to_outline = std::min(nearest_to_outline, within);
      }
    EXPECT_LT(nearest_to_outline, 0.02);
    // Segments: no sampled point of one has a larger ratio.
    for (int i = 0; i < 300; ++i) {
      const double angle = kTurn * u(random);
      const Vec3 a = (4 + u(random)) * axis.at(angle), b = (4 + u(random)) * axis.at(angle + 0.5 * u(random));
      const double ratio = profile.ratio_to_segment(a, b);
      for (int k = 0; k <= 50; ++k) {
        const Vec3 p = a + k / 50.0 * (b - a);
        const std::optional<double> outline = profile.distance(axis.angle(p));
        if (!outline) continue;
        EXPECT_TRUE(farthest ? *outline / length(p) <= ratio + 1e-6 : *outline / length(p) >= ratio - 1e-6)
            << *outline / length(p) << " " << ratio;
      }
    }
  }
}

/// The nearest or farthest crossing of edges with a direction, away from the axis; nothing where there is none.
std::optional<double> scanned(const AxisFrame& axis, const std::vector<Triangle>& faces, double angle, bool farthest) {
  const Vec3 direction = axis.at(angle), aside = cross(axis.direction, direction);
  std::optional<double> found;
  for (const Triangle& face : faces)
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = axis.across(face[i]), b = axis.across(face[(i + 1) % 3]);
      const double off = dot(aside, a), slope = dot(aside, b - a);
      if (off * (off + slope) > 0 || slope == 0) continue;
      const double at = dot(direction, a - off / slope * (b - a));
      if (at > 1e-6 && (!found || (farthest ? at > *found : at < *found))) found = at;
    }
  return found;
}

TEST(ProfileAlongAxis, IsTheOutlineOfManyTurnsOfCoarseAndFineEdges) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> u(0, 1);
  const AxisFrame axis({1, 2, 3}, normalized(Vec3{0.3, -0.2, 1}));
  const auto at = [&](double r, double angle, double along) {
    return axis.point + r * axis.at(angle) + along * axis.direction;
  };
  // Turns of a thread, each in steps of its own and begun anywhere: crests that nearly coincide. One turn in steps much
  // finer than a sector, one with faces that are seen edge-on and faces that end at the axis.
  std::vector<Triangle> faces;
  for (int turn = 0; turn < 12; ++turn) {
    const int steps = turn == 0 ? 5000 : 20 + static_cast<int>(60 * u(random));
    const double begin = kTurn * u(random), z = turn;
    for (int k = 0; k < steps; ++k) {
      const double from = begin + kTurn * k / steps, to = begin + kTurn * (k + 1) / steps;
      const double r = 5 + 0.001 * u(random);
      faces.push_back({{at(r, from, z), at(r, to, z), at(4, from, z + 0.4)}});
      if (turn == 1) faces.push_back({{at(3, from, z), at(4, from, z), at(4.5, from, z + 0.4)}});
      if (turn == 2) faces.push_back({{at(0, from, z), at(4, from, z), at(4, to, z)}});
    }
  }
  for (const bool farthest : {false, true}) {
    const ProfileAlongAxis profile(axis, faces, farthest);
    for (int k = 0; k < 3000; ++k) {
      const double angle = 3 * kTurn * (u(random) - 0.5);
      const auto found = profile.distance(angle), expected = scanned(axis, faces, angle, farthest);
      ASSERT_TRUE(found && expected);
      EXPECT_NEAR(*found, *expected, 1e-9);
    }
  }
}

TEST(ProfileAlongAxis, HasNoDistanceWhereThereAreNoFaces) {
  const AxisFrame axis({0, 0, 0}, {0, 0, 1});
  const auto at = [&](double r, double angle) { return r * axis.at(angle); };
  const std::vector<Triangle> faces{{{at(2, -0.4), at(3, 0.1), at(2, 0.5)}}};
  for (const bool farthest : {false, true}) {
    const ProfileAlongAxis profile(axis, faces, farthest);
    for (const double angle : {-3.0, -0.41, 0.51, 2.0}) EXPECT_FALSE(profile.distance(angle)) << angle;
    for (const double angle : {-0.4, -0.1, 0.2, 0.5, kTurn + 0.5}) EXPECT_TRUE(profile.distance(angle)) << angle;
    EXPECT_EQ(profile.ratio_to_segment(at(1, 1), at(1, 2)), 1);
    EXPECT_NEAR(profile.ratio_to_segment(at(1, 0.1), at(1, 0.1)), *profile.distance(0.1), 1e-12);
    EXPECT_EQ(ProfileAlongAxis(axis, {}, farthest).ratio_to_segment(at(1, 0), at(1, 1)), 1);
  }
}

}  // namespace
}  // namespace dismantle
