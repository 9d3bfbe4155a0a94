// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/helical_clearance.h"

#include "dismantle/audit/motion/profile_tree.h"
#include "dismantle/audit/triangle_axes.h"
#include "dismantle/math/angle.h"
#include "tests/audit/audit_scenes.h"
#include "tests/support/large_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace dismantle::audit {
namespace {

/// Small and large tetrahedra anywhere around the z axis.
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
    for (int k = 0; k < 4; ++k) mesh.vertices.push_back(center + reach * vector());
    Vec3* v = &mesh.vertices[first];
    if (dot(v[3] - v[0], cross(v[1] - v[0], v[2] - v[0])) > 0) std::swap(v[0], v[1]);
    for (const auto& f :
         {std::array{0u, 1u, 2u}, std::array{0u, 3u, 1u}, std::array{1u, 3u, 2u}, std::array{2u, 3u, 0u}})
      mesh.faces.push_back({{first + f[0], first + f[1], first + f[2]}});
  }
  return mesh;
}

/// A body that follows a helix about an axis, cut into frames of different length.
struct HelicalScene {
  SolidBody a, b;
  std::vector<MotionSegment> segments;
  DepthPair pair;

  HelicalScene(const TriangleMesh& fixed, const TriangleMesh& moving, const Pose& axis, double pitch, double turn,
               int frames)
      : a(scenes::component("a", scenes::moved(fixed, axis))), b(scenes::component("b", scenes::moved(moving, axis))) {
    std::vector<Frame> path;
    for (int k = 0; k <= frames; ++k) {
      const double angle = turn * (k + 0.3 * std::sin(5.0 * k)) / frames;
      const Pose along{{0, 0, pitch * angle}, quat_about({0, 0, 1}, angle)};
      path.push_back({0.1 * k, axis * along * inverse(axis)});
    }
    pair.a = &a;
    pair.b = &b;
    pair.motion.a = &a.surface();
    pair.motion.b = &b.surface();
    pair.motion.rounding = 1e-12;
    follow(path);
  }

  /// Makes b move through these frames instead.
  void follow(const std::vector<Frame>& frames) {
    segments = motion_segments(frames);
    pair.motion.motions.clear();
    const RigidTransform world_from_a = a.surface().world_from_body(Pose{});
    for (const MotionSegment& segment : segments)
      pair.motion.motions.push_back(
          relative_motion(world_from_a, b.surface().world_from_body(segment.start), segment.screw));
  }
};

Pose random_axis(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  return {10 * vector(), quat_about(normalized(vector()), normal(random))};
}

TEST(HelicalMotion, IsTheMeanOfTheTwistsWithABoundOfTheDifference) {
  std::mt19937_64 random(3);
  const HelicalScene scene(scenes::box({-1, -1, -1}, {1, 1, 1}), scenes::box({4, -1, -1}, {5, 1, 1}),
                           random_axis(random), 0.3, 9, 30);
  const auto motion = helical_motion(scene.pair.motion, {0, 30}, 1e-6);
  ASSERT_TRUE(motion.has_value());
  EXPECT_NEAR(motion->pitch, 0.3, 1e-9);
  EXPECT_LT(motion->deviation, 1e-9);
  for (std::uint32_t k = 0; k < 30; ++k) {
    const Vec3 origin = motion->axis_coordinates(scene.pair.motion.motions[k].start.translation);
    const Vec3 first = motion->axis_coordinates(scene.pair.motion.motions[0].start.translation);
    EXPECT_NEAR(std::hypot(origin.x, origin.y), std::hypot(first.x, first.y), 1e-9);
    EXPECT_NEAR(origin.z - first.z, 0.3 * motion->angles[k], 1e-9);
  }
  EXPECT_FALSE(helical_motion(scene.pair.motion, {0, 3}, 1e-6).has_value());
}

/// Frames that are off a helix: every point of b is within the deviation of the helical motion at all times.
TEST(HelicalMotion, DeviationBoundsEveryPointAtEveryInstant) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    HelicalScene scene(scenes::box({-1, -1, -1}, {1, 1, 1}), scenes::box({4, -1, -1}, {5, 1, 1}), random_axis(random),
                       0.3, 6, 20);
    std::vector<Frame> frames;
    for (const MotionSegment& segment : scene.segments) {
      const Vec3 off{normal(random), normal(random), normal(random)};
      const Pose wobble{1e-3 * off, quat_about(normalized(off), 1e-3 * normal(random))};
      frames.push_back({segment.time, wobble * segment.start});
    }
    scene.follow(frames);
    const auto motion = helical_motion(scene.pair.motion, {0, 20}, 1e-6);
    ASSERT_TRUE(motion.has_value());
    EXPECT_LT(motion->deviation, 0.2);
    const Vec3 axis = motion->frame.row[2];
    for (std::uint32_t k = 0; k < 20; ++k)
      for (const double s : {0.0, 0.3, 0.7, 1.0}) {
        const double angle = (1 - s) * motion->angles[k] + s * motion->angles[k + 1];
        const Mat3 turn = mat3_from_quat(quat_about(axis, angle));
        for (std::uint32_t v = 0; v < scene.b.surface().vertex_count(); ++v) {
          const Vec3 at_start = scene.pair.motion.motions[0].start * scene.b.surface().vertex(v);
          const Vec3 expected = motion->origin + turn * (at_start - motion->origin) + angle * motion->pitch * axis;
          const Vec3 actual = scene.pair.motion.motions[k].at(s) * scene.b.surface().vertex(v);
          EXPECT_LE(length(actual - expected), motion->deviation + 1e-12) << "segment " << k;
        }
      }
  }
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
    const auto motion = helical_motion(scene.pair.motion, {0, 20}, 1e-6);
    ASSERT_TRUE(motion.has_value());
    const ProfileFrame frame = profile_frame(scene.pair.motion, *motion);
    // Each node on the path from the root to a leaf contains points of the leaf's triangle.
    const auto check = [&](const auto& self, const ProfileTree& tree, std::uint32_t i, std::vector<std::uint32_t> above,
                           const std::vector<Triangle>& triangles) -> void {
      above.push_back(i);
      const ProfileNode& node = tree.node(i);
      if (!node.leaf()) {
        self(self, tree, i + 1, above, triangles);
        self(self, tree, node.right, above, triangles);
        return;
      }
      const Triangle t = triangles[node.face];
      for (int sample = 0; sample < 40; ++sample) {
        double s = uniform(random), w = uniform(random);
        if (s + w > 1) s = 1 - s, w = 1 - w;
        const Vec3 place = motion->axis_coordinates(t[0] + s * (t[1] - t[0]) + w * (t[2] - t[0]));
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
    for (const SolidBody* body : {&scene.a, &scene.b}) {
      const RigidTransform start = body == &scene.b ? scene.pair.motion.motions[0].start : RigidTransform{};
      std::vector<Triangle> triangles;
      for (std::uint32_t f = 0; f < body->surface().face_count(); ++f)
        triangles.push_back(transformed(start, body->surface().triangle(f)));
      check(check, ProfileTree(triangles, *motion, frame), 0, {}, triangles);
    }
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

/// The greatest depth of points of a face in the other component, at samples of the run.
double sampled_depth(const HelicalScene& scene, bool of_b, std::uint32_t face, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  const SolidBody& solid = of_b ? scene.a : scene.b;
  const Triangle t = (of_b ? scene.b : scene.a).surface().triangle(face);
  double depth = 0;
  for (int sample = 0; sample < 60; ++sample) {
    double s = uniform(random), w = uniform(random);
    if (s + w > 1) s = 1 - s, w = 1 - w;
    const Vec3 body = t[0] + s * (t[1] - t[0]) + w * (t[2] - t[0]);
    const auto segment = static_cast<std::size_t>(uniform(random) * static_cast<double>(scene.segments.size() - 1));
    const RigidTransform a_from_b = scene.pair.motion.motions[segment].at(uniform(random));
    const Vec3 point = of_b ? a_from_b * body : inverse(a_from_b) * body;
    if (solid.inside(point)) depth = std::max(depth, solid.surface().closest(point).distance);
  }
  return depth;
}

TEST(HelicalClearance, NamesNoFaceThatIsDeeperThanTheLimit) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  int clear_faces = 0, deep_faces = 0;
  for (int i = 0; i < 300; ++i) {
    const double pitch = i % 5 == 0 ? 0 : 2 * uniform(random) - 1;
    const double limit = 0.3 * uniform(random);
    const HelicalScene scene(scattered(random, 1 + i % 8, 5, 1), scattered(random, 1 + i % 8, 5, 1),
                             random_axis(random), pitch, 2.5 + 6 * uniform(random), 4 + i % 20);
    const auto last = static_cast<std::uint32_t>(scene.segments.size()) - 1;
    const auto clear = clear_in_helical_motion(scene.pair, {0, last}, limit);
    ASSERT_TRUE(clear.has_value());
    for (const bool of_b : {false, true}) {
      const std::vector<bool>& faces = of_b ? clear->of_b : clear->of_a;
      for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const double depth = sampled_depth(scene, of_b, f, random);
        clear_faces += faces[f] ? 1 : 0;
        deep_faces += depth > limit ? 1 : 0;
        if (faces[f]) {
          EXPECT_LE(depth, limit + 1e-9) << "scene " << i << ", face " << f;
        }
      }
    }
  }
  EXPECT_GT(clear_faces, 500);
  EXPECT_GT(deep_faces, 30);
}

/// A bar that turns about an axis is displaced halfway through the run, towards a wall, a ceiling or a floor.
TEST(HelicalClearance, NamesNoFaceThatAMotionBesideTheHelixBringsInside) {
  constexpr double kStep = 0.02;
  for (const double gap : {0.75 * kStep, 4 * kStep}) {
    const std::pair<TriangleMesh, Vec3> scenes[] = {{scenes::box({5 + gap, -2, -1}, {6, 2, 1}), {kStep, 0, 0}},
                                                    {scenes::box({4, -2, 0.5 + gap}, {5, 2, 2}), {0, 0, kStep}},
                                                    {scenes::box({4, -2, -2}, {5, 2, -0.5 - gap}), {0, 0, -kStep}}};
    for (const auto& [fixed, step] : scenes) {
      HelicalScene scene(fixed, scenes::box({4, -0.01, -0.5}, {5, 0.01, 0.5}), Pose{}, 0, 13, 40);
      std::vector<Frame> frames;
      for (std::size_t k = 0; k < scene.segments.size(); ++k) {
        const Pose by{k < 20 ? Vec3{} : step, {}};
        frames.push_back({scene.segments[k].time, by * scene.segments[k].start});
      }
      scene.follow(frames);
      const auto last = static_cast<std::uint32_t>(frames.size()) - 1;
      const auto clear = clear_in_helical_motion(scene.pair, {0, last}, 0);
      ASSERT_TRUE(clear.has_value());
      const auto all = [](const std::vector<bool>& faces) {
        return std::count(faces.begin(), faces.end(), false) == 0;
      };
      EXPECT_EQ(all(clear->of_a), gap > kStep) << step.z;
      EXPECT_EQ(all(clear->of_b), gap > kStep) << step.z;
    }
  }
}

TEST(HelicalClearance, ClearsAllFacesOfAThread) {
  for (const double clearance : {0.05, -0.1}) {
    const scenes::SlideScene scene = scenes::bolt_in_nut(6000, clearance);
    Path path = audit_scenes::path_of(scene.assembly, 0.1);
    std::vector<Pose> poses;
    for (int k = 0; k <= 60; ++k) poses.push_back({{0, 0, 1.25 * 0.25 * k / kTurn}, quat_about({0, 0, 1}, 0.25 * k)});
    path.moves = {audit_scenes::move_through({"bolt"}, poses)};
    const AuditReport report = audit_path(scene.assembly, path);
    EXPECT_TRUE(report.holds()) << audit_scenes::messages(report);
    EXPECT_LT(report.pieces, 400000u) << clearance;
  }
}

/// A bolt screwed out of its nut in frames of 0.25 rad, at a pitch that is wrong by `error` [mm per turn].
AuditReport audit_of_thread(double error) {
  constexpr double kClearance = 0.05, kTolerance = 0.005;
  const scenes::SlideScene scene = scenes::bolt_in_nut(6000, kClearance);
  Path path = audit_scenes::path_of(scene.assembly, kTolerance);
  std::vector<Pose> poses;
  for (int k = 0; k <= 60; ++k)
    poses.push_back({{0, 0, (1.25 + error) * 0.25 * k / kTurn}, quat_about({0, 0, 1}, 0.25 * k)});
  path.moves = {audit_scenes::move_through({"bolt"}, poses)};
  return audit_path(scene.assembly, path);
}

TEST(HelicalClearance, LetsABoltOutOnlyAlongItsThread) {
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
