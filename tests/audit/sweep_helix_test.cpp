// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/sweep_helix.h"

#include "dismantle/audit/follow_triangles.h"
#include "dismantle/math/angle.h"
#include "tests/audit/audit_scenes.h"
#include "tests/support/large_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle::audit {
namespace {

/// Small and large triangles anywhere around the z axis.
TriangleMesh scattered(std::mt19937_64& random, int count, double radius, double size) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto vector = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const double angle = kTurn * uniform(random), r = radius * uniform(random), z = 4 * uniform(random);
    const Vec3 center{r * std::cos(angle), r * std::sin(angle), z};
    const double reach = size * std::pow(10, -2 * uniform(random));
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(center + reach * vector());
    mesh.faces.push_back({{first, first + 1, first + 2}});
  }
  return mesh;
}

/// A body that follows a helix about an axis, cut into frames of different length.
struct HelicalScene {
  AuditBody a, b;
  std::vector<MotionSegment> segments;
  PairSweep pair;

  HelicalScene(const TriangleMesh& fixed, const TriangleMesh& moving, const Pose& axis, double pitch, double turn,
               int frames)
      : a(scenes::component("a", scenes::moved(fixed, axis))), b(scenes::component("b", scenes::moved(moving, axis))) {
    std::vector<Frame> path;
    for (int k = 0; k <= frames; ++k) {
      const double angle = turn * (k + 0.3 * std::sin(5.0 * k)) / frames;
      const Pose along{{0, 0, pitch * angle}, quat_about({0, 0, 1}, angle)};
      path.push_back({0.1 * k, axis * along * inverse(axis)});
    }
    segments = motion_segments(path);
    pair.a = &a;
    pair.b = &b;
    pair.allowed = 0.01;
    pair.resolution = 0.001;
    pair.rounding = 1e-12;
    const RigidTransform world_from_a = a.world_from_body(Pose{});
    for (const MotionSegment& segment : segments)
      pair.motions.push_back(relative_motion(world_from_a, b.world_from_body(segment.start), segment.screw));
  }
};

Pose random_axis(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  return {10 * vector(), quat_about(normalized(vector()), normal(random))};
}

TEST(HelicalRuns, JoinTheFramesOfOneHelicalMotion) {
  std::mt19937_64 random(3);
  const HelicalScene scene(scenes::box({-1, -1, -1}, {1, 1, 1}), scenes::box({4, -1, -1}, {5, 1, 1}),
                           random_axis(random), 0.3, 9, 30);
  const auto runs = helical_runs(scene.segments, scene.b, 1e-6);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].first, 0u);
  EXPECT_EQ(runs[0].count, 30u);  // the last segment is at rest
  const auto motion = helical_motion(scene.pair, runs[0]);
  ASSERT_TRUE(motion.has_value());
  EXPECT_NEAR(motion->pitch, 0.3, 1e-9);
  EXPECT_LT(motion->deviation, 1e-9);
  for (std::uint32_t k = 0; k < 30; ++k) {
    const Vec3 origin = motion->axis_coordinates(scene.pair.motions[k].start.translation);
    const Vec3 first = motion->axis_coordinates(scene.pair.motions[0].start.translation);
    EXPECT_NEAR(std::hypot(origin.x, origin.y), std::hypot(first.x, first.y), 1e-9);
    EXPECT_NEAR(origin.z - first.z, 0.3 * motion->angles[k], 1e-9);
  }
}

TEST(HelicalRuns, EndAtAChangeOfPitchAndOmitShortTurns) {
  const AuditBody body(scenes::component("b", scenes::box({4, -1, -1}, {5, 1, 1})));
  std::vector<Frame> path = {{0, Pose{}}};
  const auto turn = [&](int frames, double pitch) {
    for (int k = 0; k < frames; ++k) {
      const Pose by{{0, 0, 0.5 * pitch}, quat_about({0, 0, 1}, 0.5)};
      path.push_back({path.back().time + 1, by * path.back().pose});
    }
  };
  turn(6, 0.3);
  turn(3, 0.5);
  turn(8, -0.2);
  const auto runs = helical_runs(motion_segments(path), body, 1e-6);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].first, 0u);
  EXPECT_EQ(runs[0].count, 6u);
  EXPECT_EQ(runs[1].first, 9u);
  EXPECT_EQ(runs[1].count, 8u);
}

TEST(HelicalMotion, IsRefusedBeyondTheResolutionAndReportsItsDeviationWithin) {
  std::mt19937_64 random(5);
  HelicalScene scene(scenes::box({-1, -1, -1}, {1, 1, 1}), scenes::box({4, -1, -1}, {5, 1, 1}), random_axis(random),
                     0.3, 6, 20);
  scene.pair.motions[12].start.translation = scene.pair.motions[12].start.translation + Vec3{0, 0.0004, 0};
  const auto near = helical_motion(scene.pair, {0, 20});
  ASSERT_TRUE(near.has_value());
  EXPECT_GT(near->deviation, 0.000399);
  scene.pair.motions[12].start.translation = scene.pair.motions[12].start.translation + Vec3{0, 0.001, 0};
  EXPECT_FALSE(helical_motion(scene.pair, {0, 20}).has_value());
}

/// The value of a profile direction at a point, modulo turns.
double along(const ProfileFrame& frame, int k, Vec3 place) {
  return frame.of_r[k] * std::hypot(place.x, place.y) +
         frame.of_u[k] * (place.z - frame.pitch * std::atan2(place.y, place.x));
}

TEST(ProfileTree, NodesContainAllPointsOfTheirTriangles) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  for (const double pitch : {0.0, 0.2, -1.5}) {
    const HelicalScene scene(scattered(random, 60, 5, 1), scattered(random, 80, 5, 1), random_axis(random), pitch, 7,
                             20);
    const auto helical = helical_pair(scene.pair, {0, 20});
    ASSERT_TRUE(helical.has_value());
    const ProfileFrame& frame = helical->frame;
    // Each node on the path from the root to a leaf contains points of the leaf's triangle.
    const auto check = [&](const auto& self, const ProfileTree& tree, std::uint32_t i, std::vector<std::uint32_t> above,
                           const AuditBody& body, const RigidTransform& a_from_body) -> void {
      above.push_back(i);
      const ProfileNode& node = tree.node(i);
      if (!node.leaf()) {
        self(self, tree, i + 1, above, body, a_from_body);
        self(self, tree, node.right, above, body, a_from_body);
        return;
      }
      const Triangle t = transformed(a_from_body, body.triangle(node.face));
      for (int sample = 0; sample < 40; ++sample) {
        double s = uniform(random), w = uniform(random);
        if (s + w > 1) s = 1 - s, w = 1 - w;
        const Vec3 place = helical->motion.axis_coordinates(t[0] + s * (t[1] - t[0]) + w * (t[2] - t[0]));
        for (const std::uint32_t j : above) {
          const ProfileNode& outer = tree.node(j);
          EXPECT_LE(gap(outer.z, {place.z, 0}, 0), 1e-9);
          EXPECT_LE(gap(outer.r, {std::hypot(place.x, place.y), 0}, 0), 1e-9);
          EXPECT_LE(
              gap(outer.theta, make_arc(std::atan2(place.y, place.x), std::atan2(place.y, place.x), kTurn), kTurn),
              1e-9);
          for (int k = 0; k < ProfileFrame::kDirections; ++k) {
            const double value = along(frame, k, place);
            EXPECT_LE(gap(outer.along[k], make_arc(value, value, frame.circumference[k]), frame.circumference[k]), 1e-9)
                << "pitch " << pitch << ", direction " << k;
          }
        }
      }
    };
    check(check, helical->a, 0, {}, scene.a, RigidTransform{});
    check(check, helical->b, 0, {}, scene.b, scene.pair.motions[0].start);
  }
}

TEST(Arc, UnionsContainBothAndGapsAreTheShorterArc) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(-10, 10);
  constexpr double kCircle = 3;
  for (int i = 0; i < 2000; ++i) {
    const double low = uniform(random), other = uniform(random);
    const Arc p = make_arc(low, low + 0.2 * std::fabs(uniform(random)), kCircle);
    const Arc q = make_arc(other, other + 0.2 * std::fabs(uniform(random)), kCircle);
    const Arc both = united(p, q, kCircle);
    double minimum = 1e300;
    for (int k = 0; k <= 50; ++k) {
      const double in_p = p.low + p.width * k / 50, in_q = q.low + q.width * k / 50;
      EXPECT_LE(gap(both, make_arc(in_p, in_p, kCircle), kCircle), 1e-12);
      EXPECT_LE(gap(both, make_arc(in_q, in_q, kCircle), kCircle), 1e-12);
      for (int m = 0; m <= 50; ++m) {
        const double apart = std::fabs(std::remainder(in_p - (q.low + q.width * m / 50), kCircle));
        minimum = std::min(minimum, apart);
      }
    }
    if (gap(p, q, kCircle) > 0) {
      EXPECT_NEAR(gap(p, q, kCircle), minimum, 1e-9);
    }
    if (minimum > 0.2) {
      EXPECT_GT(gap(p, q, kCircle), 0);
    }
  }
}

TEST(SweepHelix, FindsTheSameBreachesAsTheGeneralSweep) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  int broken = 0, free = 0;
  for (int i = 0; i < 300; ++i) {
    const double pitch = i % 5 == 0 ? 0 : 2 * uniform(random) - 1;
    const int count = 1 + i % 12;
    const HelicalScene scene(scattered(random, count, 5, 1), scattered(random, count, 5, 1), random_axis(random), pitch,
                             2.5 + 6 * uniform(random), 4 + i % 20);
    const auto last = static_cast<std::uint32_t>(scene.segments.size()) - 1;
    const auto helical = helical_pair(scene.pair, {0, last});
    ASSERT_TRUE(helical.has_value());
    const TriangleFindings found = sweep_helix(scene.pair, *helical, {0, last});
    const TriangleFindings expected = sweep_triangles(scene.pair, motion_spans(scene.segments, 0, last, scene.b));
    EXPECT_EQ(found.breach.depth > 0, expected.breach.depth > 0) << "scene " << i;
    if (found.breach.depth > 0 && expected.breach.depth > 0) {
      EXPECT_EQ(found.breach.segment, expected.breach.segment) << "scene " << i;
    }
    (expected.breach.depth > 0 ? broken : free) += 1;
  }
  EXPECT_GT(broken, 60);
  EXPECT_GT(free, 60);
}

/// A bolt screwed out of its nut in frames of 0.25 rad, at a pitch that is wrong by `error` [mm per turn].
AuditReport audit_of_thread(double error) {
  constexpr double kClearance = 0.05, kTolerance = 0.001;
  const scenes::SlideScene scene = scenes::bolt_in_nut(6000, kClearance);
  Path path = audit_scenes::path_of(scene.assembly, kTolerance);
  std::vector<Pose> poses;
  for (int k = 0; k <= 60; ++k)
    poses.push_back({{0, 0, (1.25 + error) * 0.25 * k / kTurn}, quat_about({0, 0, 1}, 0.25 * k)});
  path.moves = {audit_scenes::move_through({"bolt"}, poses)};
  return audit_path(scene.assembly, path);
}

TEST(SweepHelix, LetsABoltOutOnlyAlongItsThread) {
  const AuditReport right = audit_of_thread(0);
  EXPECT_TRUE(right.holds()) << audit_scenes::messages(right);
  const AuditReport wrong = audit_of_thread(0.2);
  ASSERT_FALSE(wrong.holds());
  // The 0.05 mm between the flanks, minus the facets' sagitta, are used up between 0.1 and 0.5 turns.
  EXPECT_GT(wrong.violations[0].frame, 2u);
  EXPECT_LT(wrong.violations[0].frame, 13u);
}

}  // namespace
}  // namespace dismantle::audit
