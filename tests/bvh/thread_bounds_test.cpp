// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/thread_bounds.h"

#include "dismantle/math/angle.h"
#include "tests/support/large_scenes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

ThreadFrame frame_about(const Pose& pose, double lead) {
  const RigidTransform t = transform_from_pose(pose);
  ThreadFrame frame;
  frame.axis = AxisFrame(t.translation, t.rotation * Vec3{0, 0, 1});
  frame.lead = lead;
  frame.period = std::abs(lead);
  for (const double angle : {0.0, 0.5, 1.0, 2.2}) frame.add_direction({std::cos(angle), std::sin(angle)});
  return frame;
}

Vec3 random_point(const Triangle& t, int i, std::mt19937_64& random) {
  double u = std::abs(scenes::random_vector(random, 1).x), v = std::abs(scenes::random_vector(random, 1).y);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  if (i < 3) u = i == 1, v = i == 2;
  if (i >= 3 && i < 8) v = 0;  // on an edge
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

/// @return the number of triangles with bounds in a node
std::size_t expect_bounds(const TriangleMesh& mesh, const ThreadFrame& frame, double rounding, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const ObbTree tree = obb_tree_build(mesh.vertices, mesh.faces, Executor());
  const ThreadBoundsList nodes(frame, mesh.vertices, mesh.faces, tree.nodes);
  std::size_t known = 0;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (!tree.nodes[n].leaf()) continue;
    const Triangle t = mesh.triangle(tree.nodes[n].child);
    for (std::uint32_t up = tree.nodes[n].parent; up != ObbNode::kNone; up = tree.nodes[up].parent) {
      const ThreadBounds& node = nodes[up];
      if (!(node.high[0] < 1e30f)) continue;
      ++known;
      for (int i = 0; i < 20; ++i) {
        const Vec3 p = random_point(t, i, random), across = frame.axis.across(p);
        const double distance = length(across), along = frame.axis.along(p);
        EXPECT_GE(distance, node.min_radius - rounding);
        EXPECT_LE(distance, node.max_radius + rounding);
        EXPECT_GE(along, node.begin - rounding);
        EXPECT_LE(along, node.end + rounding);
        const double axial_offset = along - frame.lead * frame.axis.angle(across) / kTurn;
        // The same number of periods for all directions.
        bool inside = false;
        for (int turns = -60; turns <= 60 && !inside; ++turns) {
          inside = true;
          for (int k = 0; k < frame.direction_count; ++k) {
            const ProfileDirection d = frame.directions[k];
            const double x = d.radial * distance + d.axial * (axial_offset + turns * frame.period);
            inside &=
                x >= static_cast<double>(node.low[k]) - rounding && x <= static_cast<double>(node.high[k]) + rounding;
          }
        }
        EXPECT_TRUE(inside) << n << ' ' << up;
      }
    }
  }
  return known;
}

TEST(ThreadBoundsList, BoundEveryPointOfAThread) {
  std::mt19937_64 random(5);
  for (const double offset : {0.0, 1e3})
    for (const double lead : {1.25, -1.25, 0.9}) {
      const Pose pose = scenes::random_pose(random, offset, 3);
      scenes::Winding w = scenes::thread(0, 2);
      w.sides = 16;
      w.turns = 2;
      const TriangleMesh mesh = scenes::moved(scenes::wound_solid(w), pose);
      EXPECT_GT(expect_bounds(mesh, frame_about(pose, lead), 1e-6 * (1 + offset / 1e3), 3), 500u);
    }
}

TEST(ThreadBoundsList, BoundTrianglesOfAllShapes) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> exponent(-3, 0.9);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 900; i += 3) {
    const Vec3 at = scenes::random_vector(random, 5);
    for (int k = 0; k < 3; ++k)
      mesh.vertices.push_back(at + scenes::random_vector(random, std::pow(10, exponent(random))));
    mesh.faces.push_back({{i, i + 1, i + 2}});
  }
  EXPECT_GT(expect_bounds(mesh, frame_about({}, 2), 1e-5, 4), 300u);
}

TEST(ThreadFrame, KeepsOneOfNearlyEqualDirections) {
  ThreadFrame frame;
  frame.add_direction({0, -1});
  frame.add_direction({1e-3, 1});
  EXPECT_EQ(frame.direction_count, 1);
  for (int i = 0; i < 20; ++i) frame.add_direction({std::cos(0.3 * i), std::sin(0.3 * i)});
  EXPECT_EQ(frame.direction_count, ThreadFrame::kMaxDirections);
}

}  // namespace
}  // namespace dismantle
