// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/straight_motion.h"

#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/surface/solid_tree_query.h"
#include "tests/support/random_scenes.h"
#include "tests/support/solid_scene.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using scenes::Solid;

/// The minimum distance of all triangles at some positions of the motion.
double brute_distance(const StraightMover& moving, const SolidTree& fixed) {
  constexpr int kPlaces = 16;
  double minimum = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kPlaces; ++k)
    for (std::uint32_t a = 0; a < moving.solid.faces.size(); ++a) {
      Triangle moved = moving.solid.triangle(a);
      for (Vec3& p : moved.corner) p = moving.at * p + k / static_cast<double>(kPlaces) * moving.displacement;
      for (std::uint32_t b = 0; b < fixed.faces.size(); ++b)
        minimum = std::min(minimum, distance_triangle_triangle(moved, fixed.triangle(b)).distance);
    }
  return minimum;
}

/// Both results for a motion are true, and most motions have one.
TEST(StraightMotion, IsNeverFreeIfItMeetsNorDeepIfItDoesNot) {
  std::mt19937_64 random(5);
  int free = 0, deep = 0, unsettled = 0;
  for (const double offset : {1.0, 1e4})
    for (int i = 0; i < 100; ++i) {
      const Pose pose = scenes::random_pose(random, offset, 3);
      const Solid fixed(scenes::moved(scenes::tube(3, 1, -2, 2, 9, 1), pose));
      const Vec3 at = assembled_bounds(fixed.assembly.components[0]).center();
      // Assembled elsewhere, but moved near.
      const Pose own = scenes::random_pose(random, offset, 3);
      const Solid solid(scenes::moved(scenes::tube(0.8, 0.3, -1, 1, 7, 1), own));
      const Pose near{at + scenes::random_vector(random, 4), pose.rotation};
      const StraightMover moving{solid.tree, transform_from_pose(near * inverse(own)),
                                 scenes::random_vector(random, 8)};
      const bool passes = passes_by(moving, fixed.tree);
      const auto found = deep_vertex_on(moving, fixed.tree, 0.05);
      ASSERT_FALSE(passes && found);
      free += passes;
      deep += found.has_value();
      unsettled += !passes && !found;
      if (passes) {
        ASSERT_GT(brute_distance(moving, fixed.tree), 0) << i;
      }
      if (!found) continue;
      ASSERT_GE(found->fraction, 0);
      ASSERT_LE(found->fraction, 1);
      // There it is a vertex of one of the two, deep in the other.
      const Vec3 of_moving = inverse(moving.at) * (found->point - found->fraction * moving.displacement);
      const auto is_deep = [](const SolidTree& in, const Vec3& p) {
        return point_in_solid(in, p) && nearest_face(in, p, NearestFace::kNone).distance > 0.05 - 1e-6;
      };
      const bool in_fixed = is_deep(fixed.tree, found->point), in_moving = is_deep(solid.tree, of_moving);
      ASSERT_TRUE(in_fixed || in_moving);
      const auto is_corner = [&](const SolidTree& of, std::uint32_t face, const Vec3& p) {
        const Triangle t = of.triangle(face);
        return std::any_of(t.corner, t.corner + 3, [&](const Vec3& c) { return length(c - p) < 1e-9 * (1 + offset); });
      };
      ASSERT_TRUE(in_fixed ? is_corner(solid.tree, found->face_moving, of_moving)
                           : is_corner(fixed.tree, found->face_fixed, found->point));
    }
  EXPECT_GT(free, 40);
  EXPECT_GT(deep, 40);
  EXPECT_LT(unsettled, 40) << free << " free, " << deep << " deep";
}

TEST(StraightMotion, PassesObstaclesBehindOrBesideItsShadow) {
  const Solid bar(scenes::box({-1, -1, 0}, {1, 1, 2})), plate(scenes::box({1.01, -500, 5}, {500, 500, 6})),
      behind(scenes::box({-5, -5, -2}, {5, 5, -0.01})), beyond(scenes::box({-5, -5, 12.01}, {5, 5, 13}));
  for (const Solid* other : {&plate, &behind, &beyond}) EXPECT_TRUE(passes_by({bar.tree, {}, {0, 0, 10}}, other->tree));
  EXPECT_FALSE(passes_by({bar.tree, {}, {0.1, 0, 10}}, plate.tree));
  EXPECT_FALSE(passes_by({bar.tree, {}, {0, 0, -10}}, behind.tree));
  EXPECT_FALSE(passes_by({bar.tree, {}, {0, 0, 10.2}}, beyond.tree));
}

TEST(StraightMotion, IsDeepAtADeepVertexUnlessTheOtherIsThinOrOpen) {
  const Solid bar(scenes::box({-1, -1, 0}, {1, 1, 2})), wall(scenes::box({-5, -5, 3}, {5, 5, 4})),
      foil(scenes::box({-5, -5, 3}, {5, 5, 3.05}));
  EXPECT_TRUE(deep_vertex_on({bar.tree, {}, {0, 0, 10}}, wall.tree, 0.1));
  EXPECT_TRUE(deep_vertex_on({wall.tree, {}, {0, 0, -1.5}}, bar.tree, 0.1)) << "the bar's vertices are in the wall";
  EXPECT_FALSE(deep_vertex_on({bar.tree, {}, {0, 0, 0.9}}, wall.tree, 0.1)) << "it does not move that far";
  EXPECT_FALSE(deep_vertex_on({bar.tree, {}, {0, 0, -10}}, wall.tree, 0.1));
  EXPECT_FALSE(deep_vertex_on({bar.tree, {}, {0, 0, 10}}, foil.tree, 0.1)) << "nothing can be that deep in a foil";
  TriangleMesh open = scenes::box({-5, -5, 3}, {5, 5, 4});
  open.faces.resize(open.faces.size() - 2);
  EXPECT_FALSE(deep_vertex_on({bar.tree, {}, {0, 0, 10}}, Solid(open).tree, 0.1));
}

TEST(StraightMotion, IgnoresVerticesWithoutFaces) {
  TriangleMesh mesh = scenes::box({-1, -1, 0}, {1, 1, 2});
  mesh.vertices.push_back({20, 0, 0});
  Component component = scenes::component("bar", scenes::box({-1, -1, 0}, {1, 1, 2}));
  component.mesh = std::make_shared<const TriangleMesh>(mesh);
  const SolidTree bar = make_solid_tree(component, {});
  const Solid post(scenes::box({15, -5, 3}, {25, 5, 6}));
  EXPECT_FALSE(deep_vertex_on({bar, {}, {0, 0, 10}}, post.tree, 0.1));
}

}  // namespace
}  // namespace dismantle
