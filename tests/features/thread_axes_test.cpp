// SPDX-License-Identifier: Apache-2.0
#include "dismantle/features/thread_axes.h"

#include "tests/support/large_scenes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace dismantle {
namespace {

std::vector<ThreadAxis> threads_of(const TriangleMesh& mesh) {
  return thread_axes(mesh.vertices, mesh.faces, revolution_axes(mesh.vertices, mesh.faces));
}

scenes::Winding winding(std::uint32_t sides, std::uint32_t turns) {
  scenes::Winding w = scenes::thread(0, 1);
  w.sides = sides;
  w.turns = turns;
  return w;
}

TriangleMesh mirrored(TriangleMesh mesh) {
  for (Vec3& p : mesh.vertices) p.x = -p.x;
  for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  return mesh;
}

TEST(ThreadAxes, FindTheLeadOfAThreadInAnyPose) {
  std::mt19937_64 random(11);
  for (const double offset : {0.0, 1e3})
    for (const std::uint32_t sides : {24u, 100u})
      for (const bool inner : {false, true})
        for (const bool left : {false, true}) {
          const scenes::Winding w = winding(sides, 6);
          const TriangleMesh straight = inner ? scenes::wound_hole(w, 7) : scenes::wound_solid(w);
          const Pose pose = scenes::random_pose(random, offset, 3);
          const TriangleMesh mesh = scenes::moved(left ? mirrored(straight) : straight, pose);
          const std::vector<ThreadAxis> threads = threads_of(mesh);
          ASSERT_EQ(threads.size(), 1u) << offset << ' ' << sides << ' ' << inner << ' ' << left;
          EXPECT_NEAR(threads[0].lead, left ? -1.25 : 1.25, 1e-5);
          EXPECT_EQ(threads[0].starts, 1);
          const Vec3 axis = mat3_from_quat(pose.rotation) * Vec3{0, 0, 1};
          EXPECT_LT(length(cross(threads[0].direction, axis)), 1e-6);
          EXPECT_LT(length(cross(threads[0].point - pose.position, axis)), 1e-5);
          // Flanks at 30 degrees to the plane across the axis: out of the bolt, and to the axis of the nut.
          int flanks = 0;
          for (const ThreadAxis::Flank& flank : threads[0].flanks)
            flanks += std::abs(flank.normal.radial - (inner ? -0.5 : 0.5)) < 0.02;
          EXPECT_EQ(flanks, 2);
        }
}

TEST(ThreadAxes, FindTheLeadOfARemeshedThreadInAnyPose) {
  std::mt19937_64 random(3);
  for (const double offset : {0.0, 1e3})
    for (const bool left : {false, true}) {
      const scenes::Winding bolt = winding(60, 9), nut = winding(70, 5);
      const Pose pose = scenes::random_pose(random, offset, 3);
      std::vector<ThreadAxis> found;
      for (const bool inner : {false, true}) {
        const TriangleMesh straight = scenes::with_other_vertices(inner ? nut : bolt, inner, 14, random);
        const std::vector<ThreadAxis> threads = threads_of(scenes::moved(left ? mirrored(straight) : straight, pose));
        ASSERT_EQ(threads.size(), 1u) << offset << ' ' << inner << ' ' << left;
        EXPECT_NEAR(threads[0].lead, left ? -1.25 : 1.25, 1e-3);
        EXPECT_EQ(threads[0].starts, 1);
        const Vec3 axis = mat3_from_quat(pose.rotation) * Vec3{0, 0, 1};
        EXPECT_LT(length(cross(threads[0].direction, axis)), 2e-3);
        EXPECT_LT(length(cross(threads[0].point - pose.position, axis)), 0.01);
        found.push_back(threads[0]);
      }
      EXPECT_TRUE(threads_mate(found[0], found[1]));
    }
}

TEST(ThreadAxes, DistinguishSeveralStartsFromOne) {
  scenes::Winding w = winding(48, 4);
  const scenes::Profile once = w.profile;
  for (std::size_t i = 1; i < once.size(); ++i) w.profile.push_back({once[i].x, once[i].y + w.pitch});
  w.pitch *= 2;
  const std::vector<ThreadAxis> threads = threads_of(scenes::wound_solid(w));
  ASSERT_EQ(threads.size(), 1u);
  EXPECT_NEAR(threads[0].lead, 2.5, 1e-5);
  EXPECT_EQ(threads[0].starts, 2);
}

TEST(ThreadAxes, AreNotFoundWithoutAHelix) {
  for (const TriangleMesh& mesh : {scenes::tube(10, 6, -20, 20, 48, 9), scenes::box({0, 0, 0}, {3, 4, 5}),
                                   scenes::extruded(scenes::circle(5, 6), 0, 4),
                                   scenes::revolved_loop({{4, 0}, {6, 1}, {5, 2}, {6, 3}, {4, 4}}, 40), TriangleMesh{}})
    EXPECT_TRUE(threads_of(mesh).empty()) << mesh.faces.size();
}

TEST(ThreadAxes, MateOnlyAsAScrewAndItsNut) {
  const auto thread_of = [](const TriangleMesh& mesh) { return threads_of(mesh).at(0); };
  const TriangleMesh bolt = scenes::wound_solid(winding(24, 6));
  const ThreadAxis screw = thread_of(bolt), nut = thread_of(scenes::wound_hole(winding(24, 4), 7));
  EXPECT_TRUE(threads_mate(screw, nut));
  EXPECT_TRUE(threads_mate(nut, screw));
  EXPECT_TRUE(threads_mate(thread_of(scenes::moved(bolt, {{0.2, 0, 9}, {}})), nut));
  EXPECT_FALSE(threads_mate(screw, screw));
  EXPECT_FALSE(threads_mate(thread_of(mirrored(bolt)), nut));
  EXPECT_FALSE(threads_mate(thread_of(scenes::moved(bolt, {{0.4, 0, 0}, {}})), nut));
  EXPECT_FALSE(threads_mate(thread_of(scenes::moved(bolt, {{}, quat_about({1, 0, 0}, 0.05)})), nut));
}

TEST(ThreadParts, AreNarrowBandsOfTheProfile) {
  const TriangleMesh mesh = scenes::wound_solid(winding(64, 8));
  const std::vector<ThreadAxis> threads = threads_of(mesh);
  ASSERT_EQ(threads.size(), 1u);
  const std::vector<std::uint8_t> parts = thread_parts(mesh.vertices, mesh.faces, threads);
  ASSERT_EQ(parts.size(), mesh.faces.size());
  std::map<int, std::size_t> counts;
  for (const std::uint8_t part : parts) ++counts[part];
  ASSERT_EQ(counts.size(), 5u) << "the ends, two flanks, roots and crests";
  EXPECT_LT(counts[0], mesh.faces.size() / 10);
  for (std::size_t f = 0; f < parts.size(); ++f) {
    if (parts[f] == 0) continue;
    double minimum = 1e9, maximum = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh.triangle(f)[k];
      minimum = std::min(minimum, std::hypot(p.x, p.y));
      maximum = std::max(maximum, std::hypot(p.x, p.y));
    }
    if (parts[f] == 3) {
      EXPECT_LT(maximum, 3.4) << "a root";
    } else if (parts[f] == 4) {
      EXPECT_GT(minimum, 3.9) << "a crest";
    }
  }
  EXPECT_TRUE(thread_parts(mesh.vertices, mesh.faces, {}).empty());
}

}  // namespace
}  // namespace dismantle
