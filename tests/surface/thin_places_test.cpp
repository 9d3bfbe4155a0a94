// SPDX-License-Identifier: Apache-2.0
// Tests of solids that are thin in places only, where a limit of depth alone keeps nothing from passing through.
#include "dismantle/surface/depth/thin_places.h"

#include "dismantle/surface/depth/shallow_region.h"
#include "dismantle/surface/depth/swept_depth.h"
#include "tests/support/depth_oracle.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/puzzle_scenes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/shaped_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace dismantle {
namespace {

using Solid = scenes::ShapedSolid;

/// A block (x > 0) with a flange (x < 0) of this thickness, from y = 0 up.
TriangleMesh flanged_block(double thickness) {
  return scenes::box_block({{{-10, -4, 0, 10}, {0, thickness, 10}, {-5, 0, 5}}},
                           [](int i, int j, int) { return i == 2 || j == 0; });
}

/// True for the two sides of its flange.
bool on_flange(const Triangle& face, double thickness) {
  const auto at_height = [&](double y) {
    return std::all_of(face.corner, face.corner + 3, [&](Vec3 p) { return p.x <= 0 && p.y == y; });
  };
  return at_height(0) || at_height(thickness);
}

TriangleMesh mesh_of(const SurfaceTree& surface) {
  TriangleMesh mesh;
  for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
    for (const Vec3& p : surface.triangle(f).corner) mesh.vertices.push_back(p);
    mesh.faces.push_back({{3 * f, 3 * f + 1, 3 * f + 2}});
  }
  return mesh;
}

RigidTransform moved(Vec3 by) {
  RigidTransform result;
  result.translation = by;
  return result;
}

TEST(ThinPlaces, AreTheTwoSidesOfAWallThatIsThinnerThanTwiceTheLimit) {
  const TriangleMesh block = flanged_block(1);
  for (const TriangleMesh& mesh : {block, scenes::inside_out(block)}) {
    const Solid solid(mesh);
    const ThinPlaces thin(solid.shape, 0.51);
    EXPECT_FALSE(thin.everywhere());
    EXPECT_FALSE(thin.none());
    ASSERT_TRUE(thin.thick_faces());
    // Of the block, only the bottom is next to the flange.
    EXPECT_EQ(thin.thick_faces()->face_count() + thin.thin_faces()->face_count(), mesh.faces.size());
    for (std::uint32_t f = 0; f < thin.thick_faces()->face_count(); ++f)
      EXPECT_FALSE(on_flange(thin.thick_faces()->triangle(f), 1));
    for (std::uint32_t f = 0; f < thin.thin_faces()->face_count(); ++f) {
      const Triangle& t = thin.thin_faces()->triangle(f);
      const bool at_bottom = t[0].y == 0 && t[1].y == 0 && t[2].y == 0;
      EXPECT_TRUE(at_bottom || on_flange(t, 1));
    }
    EXPECT_TRUE(ThinPlaces(solid.shape, 0.49).none());
    EXPECT_FALSE(ThinPlaces(solid.shape, 0.49).thick_faces());
  }
}

TEST(ThinPlaces, AreNotTheTwoSidesOfASlot) {
  const Solid slotted(scenes::box_block({{{-10, -0.2, 0.2, 10}, {0, 5, 10}, {-5, 5}}},
                                        [](int i, int j, int) { return i != 1 || j == 0; }));
  EXPECT_TRUE(ThinPlaces(slotted.shape, 2).none());
  EXPECT_FALSE(ThinPlaces(slotted.shape, 2.6).none()) << "the bottom of the slot is 5 mm thick";
}

TEST(ThinPlaces, AreAllFacesOfASolidThatIsNowhereDeeper) {
  const Solid plate(scenes::box({-5, -5, 0}, {5, 5, 1}));
  const ThinPlaces thin(plate.shape, 0.51);
  EXPECT_TRUE(thin.everywhere());
  EXPECT_FALSE(thin.none());
  EXPECT_FALSE(thin.thick_faces());
}

TEST(FirstDeeper, KeepsFarPointsOutOfAFlangeThatALimitLetsThrough) {
  // The end of a beam is half as deep in the flange as that is thick.
  const Solid block(flanged_block(1));
  const Solid beam(scenes::box({-7.4, 0.5, -0.4}, {-6.6, 9, 0.4}));
  const double limit = 0.51, tolerance = 0.01;
  const auto sweep = [&](Vec3 way, const DepthLimits& limits) {
    return first_deeper({&beam.shape, &block.shape, {}, moved(way)}, limits, 1e-4);
  };
  EXPECT_FALSE(sweep({0, -6, 0}, {limit, limit, limit}));  // all of the beam could go through
  const DepthLimits limits{limit, tolerance, limit};
  EXPECT_FALSE(sweep({0, 20, 0}, limits));
  const auto down = sweep({0, -6, 0}, limits);
  ASSERT_TRUE(down);
  EXPECT_TRUE(down->of_a);
  EXPECT_NEAR(6 * down->free_until, limit + tolerance, 2 * 6e-4);
  // The block, where it is thick, stops it by the limit: the end of the beam is 0.49 below the edge of its side.
  const auto across = sweep({12, 0, 0}, limits);
  ASSERT_TRUE(across);
  EXPECT_NEAR(12 * across->free_until, 6.6 + std::sqrt(limit * limit - 0.49 * 0.49), 2 * 12e-4);
}

TEST(FirstDeeper, LetsFarPointsGetDeeperNextToABoreInAThinFlange) {
  // A rod that fills its bore with an overlap as deep as the flange is half thick: the bore is within the limit.
  const TriangleMesh flange =
      scenes::round_block({2, 6, 12}, {0, 0.6, 8}, 48, [](int i, int, int k) { return i == 0 || k == 0; });
  const Solid bored(flange), rod(scenes::tube(2.25, 0, -2, 9, 48));
  const DepthLimits limits{0.31, 0.01, std::numeric_limits<double>::infinity()};
  ASSERT_FALSE(bored.shape.thin_places(0.31).none());
  ASSERT_TRUE(bored.shape.thin_places(0.31).thick_faces());
  EXPECT_FALSE(first_deeper({&rod.shape, &bored.shape, {}, moved({0, 0, 12})}, limits, 1e-4));
  const auto sideways = first_deeper({&rod.shape, &bored.shape, {}, moved({2, 0, 0})}, limits, 1e-4);
  ASSERT_TRUE(sideways);
  EXPECT_LT(2 * sideways->time, 0.1);
}

TEST(FirstDeeper, LetsFarPointsWhereTheirSolidWasIfThatIsAHole) {
  // A rod through the flange, along itself, askew, and aside.
  const Solid block(flanged_block(1)), rod(scenes::tube(0.4, 0, -4, 9, 11));
  const RigidTransform upright = transform_from_pose({{-6, 0, 0}, quat_about({1, 0, 0}, -kTurn / 4)});
  TriangleMesh mesh = *rod.component.mesh;
  for (Vec3& p : mesh.vertices) p = upright * p;
  const Solid placed(mesh);
  const auto free_until = [&](const RigidTransform& end, bool has_hole) {
    const auto found = first_deeper({&placed.shape, &block.shape, {}, end}, {0.51, 0.01, 0.51, has_hole, false}, 1e-4);
    return found ? found->free_until : 1;
  };
  EXPECT_EQ(free_until(moved({0, 9, 0}), true), 1);
  EXPECT_NEAR(9 * free_until(moved({0, 9, 0}), false), 0.51 + 0.01, 0.002) << "what was 0.51 away gets 0.01 deep";
  // Askew, it is 0.51 mm beside the hole after so much of the way.
  EXPECT_EQ(free_until(moved({-0.5, 9, 0}), true), 1);
  const double askew = free_until(moved({-1.5, 9, 0}), true);
  EXPECT_GT(askew, 0.3);
  EXPECT_LT(askew, 0.6);
}

TEST(FirstDeeper, AgreesWithSamplesNextToThinPlaces) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> u(-1, 1);
  constexpr double kFar = 0.02, kResolution = 0.004;
  int by_far = 0, by_limit = 0, free = 0;
  for (int i = 0; i < 60; ++i) {
    const double thickness = 0.8 + 0.3 * u(random), limit = thickness / 2 + 0.02;
    const TriangleMesh block = flanged_block(thickness);
    const TriangleMesh bar =
        scenes::moved(scenes::box({-0.5, -3, -0.6}, {0.5, 3, 0.6}),
                      {{-5 + 5.5 * u(random), thickness + 2.5 + u(random), 2 * u(random)},
                       quat_about(normalized(Vec3{u(random), u(random), u(random)}), 0.4 * u(random))});
    const Solid a(bar), b(block);
    const TriangleMesh thick = mesh_of(*b.shape.thin_places(limit).thick_faces());
    const RigidTransform end = transform_from_pose(
        {{3 * u(random), -2.5 + 2.5 * u(random), u(random)}, quat_about({0, 0, 1}, 0.1 * u(random))});
    const auto is_deep = [&](Vec3 own, double time) {
      const Vec3 p = (1 - time) * own + time * (end * own);
      const double depth = oracle::distance(block, p);
      if (depth <= kFar + 1e-9 || oracle::winding_number(block, p) < 0.5) return false;
      const bool within = oracle::distance(block, own) <= limit || oracle::distance(thick, p) <= limit + 1e-9;
      return depth > limit + 1e-9 || !within;
    };
    const auto deep_at = [&](double time) {
      int count = 0;
      for (const Face& f : bar.faces)
        oracle::for_each_sample(bar.vertices[f.v[0]], bar.vertices[f.v[1]], bar.vertices[f.v[2]], 0.2,
                                [&](Vec3 p) { count += is_deep(p, time); });
      return count;
    };
    if (deep_at(0) > 0) continue;
    // Points of the block have no limit in the bar.
    const auto found = first_deeper({&a.shape, &b.shape, {}, end}, {limit, kFar, limit}, kResolution);
    const double free_until = found ? found->free_until : 1;
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0})
      EXPECT_EQ(deep_at(share * free_until), 0) << "scene " << i << " at " << share * free_until;
    if (!found) {
      ++free;
      continue;
    }
    EXPECT_TRUE(found->is_certain) << i;
    EXPECT_LE(found->time - found->free_until, kResolution * (1 + 1e-9)) << i;
    ASSERT_TRUE(found->of_a) << i;
    const double depth = oracle::distance(block, found->point);
    (depth > limit ? by_limit : by_far) += 1;
    EXPECT_GT(depth, kFar - 1e-9) << i;
    EXPECT_GT(oracle::distance(thick, found->point), limit - 1e-9) << i;
  }
  EXPECT_GT(by_far, 10);
  EXPECT_GT(by_limit, 1);
  EXPECT_GT(free, 5);
}

}  // namespace
}  // namespace dismantle
