// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/pair_motion.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dismantle::audit {
namespace {

/// Expects that two meshes, which are `distance` apart, are known to be just where they are further apart than the
/// margin; in the frame that they are given in, and turned somewhere else.
void expect_apart_by(double distance, const TriangleMesh& a, const TriangleMesh& b, std::mt19937_64& random) {
  for (const double offset : {0.0, 50.0}) {
    const Pose somewhere = scenes::random_pose(random, offset, 3);
    const AuditBody first(scenes::component("a", scenes::moved(a, somewhere))),
        second(scenes::component("b", scenes::moved(b, somewhere)));
    const RigidTransform at_a = first.world_from_body({}), at_b = second.world_from_body({});
    const RigidTransform a_from_b = inverse(at_a) * at_b;
    for (const double share : {0.1, 0.9, 0.999, 1.001, 1.1, 10.0}) {
      EXPECT_EQ(surfaces_apart(first, second, a_from_b, share * distance), share < 1) << distance << " x " << share;
      EXPECT_EQ(surfaces_apart(second, first, inverse(a_from_b), share * distance), share < 1) << distance;
    }
  }
}

TEST(SurfacesApart, AreThoseOfBoxesAndOfAShaftInItsBoreThatAreFurtherApartThanTheMargin) {
  std::mt19937_64 random(3);
  const TriangleMesh floor = scenes::box({-4, -3, -1}, {4, 3, 0}), bore = scenes::tube(7, 5, 0, 10, 24, 3);
  for (const double distance : {0.001, 0.05, 1.0}) {
    expect_apart_by(distance, floor, scenes::box({1, 1, distance}, {2, 9, 3}), random);
    expect_apart_by(distance, floor, scenes::box({4 + distance, -9, -2}, {5, 9, 3}), random);
    // Facets beside facets.
    const double radius = 5 - distance / std::cos(std::acos(-1.0) / 24);
    expect_apart_by(distance, bore, scenes::tube(radius, 0, -2, 12, 24, 4), random);
    expect_apart_by(distance, scenes::tube(radius, 2, 1, 4, 24), bore, random);
  }
}

TEST(SurfacesApart, AreNotThoseThatMeet) {
  const AuditBody a(scenes::component("a", scenes::box({0, 0, 0}, {2, 2, 2}))),
      b(scenes::component("b", scenes::tube(0.3, 0, -5, 5, 12))), empty(scenes::component("c", {}));
  const RigidTransform at_a = a.world_from_body({});
  for (const Vec3 by : {Vec3{1, 1, 1}, {0, 1, 1}, {2.2, 1, 1}})
    EXPECT_FALSE(surfaces_apart(a, b, inverse(at_a) * b.world_from_body(Pose{by, {}}), 0));
  EXPECT_TRUE(surfaces_apart(a, b, inverse(at_a) * b.world_from_body(Pose{{2.4, 1, 1}, {}}), 0.09));
  EXPECT_TRUE(surfaces_apart(a, empty, {}, 1));
  EXPECT_TRUE(surfaces_apart(empty, b, {}, 1));
}

}  // namespace
}  // namespace dismantle::audit
