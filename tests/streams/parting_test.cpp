// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/parting.h"

#include "dismantle/bvh/bvh_traverse.h"
#include "dismantle/streams/moving_streams.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

constexpr double kTolerance = 0.01;

/// Two closed components; the second moves in one step.
class Pair {
 public:
  Pair(TriangleMesh a, TriangleMesh b, const Pose& end)
      : streams_(scenes::assembly({scenes::component("a", std::move(a)), scenes::component("b", std::move(b))}), {}) {
    const RigidTransform moved = transform_from_pose(end);
    streams_.set_next(std::vector<RigidTransform>{{}, moved}, {});
    streams_.refit({});
    const Bvh& bvh = streams_.fixed().bvh;
    bvh_traverse(BvhView(bvh), streams_.bounds(), {bvh.root(), bvh.root()},
                 [&](NodeIndex x, NodeIndex y) { pairs_.push_back(pair_key(x, y)); });
    for (const Vec3& v : streams_.fixed().vertices_of(ComponentId(1)))
      displacement_ = std::max(displacement_, length(moved * v - v));
  }

  EmbeddedMotion motion() const {
    EmbeddedMotion m;
    m.streams = &streams_.fixed();
    m.step = {streams_.vertices_t0(), streams_.vertices_t1(), streams_.fixed().faces};
    m.bounds = streams_.bounds();
    m.a = ComponentId(0);
    m.b = ComponentId(1);
    m.a_closed = m.b_closed = true;
    m.triangle_pairs = pairs_;
    m.displacement = displacement_;
    m.tolerance = kTolerance;
    return m;
  }
  std::optional<double> parted() const { return parted_from(motion()); }
  bool intersects(double s) const { return components_intersect(motion(), s); }
  /// The share of the step that the tolerance is.
  double resolution() const { return kPartingShare * kTolerance / displacement_; }

 private:
  MovingStreams streams_;
  std::vector<std::uint64_t> pairs_;
  double displacement_ = 0;
};

Pose shift(double x, double y, double z) {
  return {{x, y, z}, {}};
}

TEST(PartedFrom, IsNeverWhileAPegStaysInItsPlate) {
  const Pair pair(scenes::box({-5, -5, -1}, {5, 5, 0}), scenes::box({-1, -1, -0.5}, {1, 1, 3}), shift(2, 1, 0.3));
  EXPECT_EQ(pair.parted(), std::nullopt);
}

// The peg's foot is 0.5 mm deep and moves up by 2 mm: it is out after a quarter of the step.
TEST(PartedFrom, IsTheTimeAtWhichAPegLeavesItsPlate) {
  const Pair pair(scenes::box({-5, -5, -1}, {5, 5, 0}), scenes::box({-1, -1, -0.5}, {1, 1, 3}), shift(0.01, 0.02, 2));
  ASSERT_TRUE(pair.parted().has_value());
  EXPECT_LE(*pair.parted(), 0.25);
  EXPECT_GE(*pair.parted(), 0.25 - 2 * pair.resolution());
}

// From one wall of a channel through the gap into the other: embedded at both ends, apart in between.
TEST(PartedFrom, SeesThatAPegIsApartBetweenTwoWalls) {
  TriangleMesh channel = scenes::box({0, -5, -5}, {1, 5, 5});
  const TriangleMesh wall = scenes::box({6, -5, -5}, {7, 5, 5});
  for (const Vec3& p : wall.vertices) channel.vertices.push_back(p);
  for (const Face& f : wall.faces) channel.faces.push_back({{f.v[0] + 8, f.v[1] + 8, f.v[2] + 8}});
  const Pair pair(channel, scenes::box({0.4, -1, -1}, {2, 1, 1}), shift(5.1, 0, 0.1));
  EXPECT_TRUE(pair.intersects(0));
  EXPECT_TRUE(pair.intersects(1));
  ASSERT_TRUE(pair.parted().has_value());
  EXPECT_LE(*pair.parted(), 0.6 / 5.1);
  EXPECT_GE(*pair.parted(), 0.6 / 5.1 - 2 * pair.resolution());
}

TEST(PartedFrom, IsNeverWhileOneSolidStaysInsideAnother) {
  const Pair pair(scenes::box({-5, -5, -5}, {5, 5, 5}), scenes::tube(1, 0.5, -1, 1, 16), shift(1, 2, 3));
  EXPECT_EQ(pair.parted(), std::nullopt);
}

// Inside, then through the surface, then out: one at a time.
TEST(PartedFrom, FollowsASolidOutOfAnother) {
  const Pair pair(scenes::box({-5, -5, -5}, {5, 5, 5}), scenes::box({-1, -1, -1}, {1, 1, 1}), shift(0.1, 0.2, 12));
  ASSERT_TRUE(pair.parted().has_value());
  EXPECT_LE(*pair.parted(), 0.5);
  EXPECT_GE(*pair.parted(), 0.5 - 2 * pair.resolution());
}

TEST(PartedFrom, IsNeverWhileAFineMeshSlidesWithChangingTrianglePairs) {
  const Pair pair(scenes::box({-5, -5, -1}, {5, 5, 0}), scenes::tube(2, 1, -6, 6, 48, 60), shift(0.05, 0.03, 4));
  EXPECT_EQ(pair.parted(), std::nullopt);
}

TEST(PartedFrom, StartsTheContinuousTestWithinItsAllowanceWhateverTheDeviation) {
  for (const double deviation : {0.0, 0.125 * kTolerance, 0.25 * kTolerance}) {
    const Pair pair(scenes::box({-50, -50, -1}, {50, 50, 0}), scenes::tube(1, 0, -0.5, 3, 32, 8), shift(0.2, 0.1, 2));
    EmbeddedMotion motion = pair.motion();
    motion.path_deviation = deviation;
    const std::optional<double> from = parted_from(motion);
    ASSERT_TRUE(from.has_value());
    EXPECT_LE(*from, 0.25);
    EXPECT_GE(*from, 0.25 - 2 * pair.resolution() - 2 * deviation / 2);
  }
}

TEST(PartedFrom, IsAtOnceIfTwoBoxesOnlyTouch) {
  const Pair pair(scenes::box({0, 0, 0}, {2, 2, 2}), scenes::box({2, 0.5, 0.5}, {3, 1.5, 1.5}), shift(0, 0.3, 0));
  ASSERT_TRUE(pair.parted().has_value());
  EXPECT_EQ(*pair.parted(), 0);
}

TEST(PartedFrom, NeverClaimsAnIntersectionAtATimeWithoutOne) {
  int parted = 0, together = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const Pose where = scenes::random_pose(random, 1.2, 3);
    const Pair pair(scenes::box({-1, -1.1, -0.9}, {1, 1, 1.2}),
                    scenes::moved(seed % 2 == 0 ? scenes::box({-1, -0.5, -0.4}, {1, 0.6, 0.5})
                                                : scenes::tube(0.8, 0.4, -0.7, 0.9, 12, 2),
                                  where),
                    scenes::random_pose(random, seed % 3 == 0 ? 3 : 0.8, 0.7));
    if (!pair.intersects(0)) continue;
    const std::optional<double> from = pair.parted();
    ++(from ? parted : together);
    const double until = from.value_or(1);
    for (int i = 0; i <= 60; ++i) ASSERT_TRUE(i == 60 && from ? true : pair.intersects(until * i / 60)) << i;
  }
  EXPECT_GT(parted, 20);
  EXPECT_GT(together, 20);
}

}  // namespace
}  // namespace dismantle
