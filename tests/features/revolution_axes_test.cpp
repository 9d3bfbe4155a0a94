// SPDX-License-Identifier: Apache-2.0
#include "dismantle/features/revolution_axes.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace dismantle {
namespace {

double off(const RevolutionAxis& axis, Vec3 p) {
  return length(cross(p - axis.point, axis.direction));
}

TEST(RevolutionAxes, FindsTheAxisOfATubeInAnyPose) {
  std::mt19937_64 random(3);
  for (const double offset : {0.0, 10.0, 1e4})
    for (const std::uint32_t sides : {12u, 64u, 400u})
      for (const std::uint32_t rings : {1u, 7u}) {
        const Pose pose = scenes::random_pose(random, offset, 3);
        const TriangleMesh mesh = scenes::moved(scenes::tube(10, 6, -20, 20, sides, rings), pose);
        const std::vector<RevolutionAxis> axes = revolution_axes(mesh.vertices, mesh.faces);
        ASSERT_EQ(axes.size(), 1u) << offset << ' ' << sides;
        EXPECT_NEAR(length(axes[0].direction), 1, 1e-12);
        EXPECT_LT(off(axes[0], transform_from_pose(pose) * Vec3{0, 0, -20}), 1e-6);
        EXPECT_LT(off(axes[0], transform_from_pose(pose) * Vec3{0, 0, 20}), 1e-6);
        EXPECT_LT(length(axes[0].point - pose.position), 1e-6) << "nearest to the middle";
        EXPECT_NEAR(axes[0].min_radius, 6, 1e-5);
        EXPECT_NEAR(axes[0].max_radius, 10, 1e-5);
      }
}

TEST(RevolutionAxes, OrientationAndRoundingDoNotDivideAnAxis) {
  std::mt19937_64 random(4);
  const TriangleMesh straight = scenes::tube(10, 6, -20, 20, 48, 3);
  const double turn = revolution_axes(straight.vertices, straight.faces).at(0).turn;
  for (int i = 0; i < 300; ++i) {
    Pose pose = scenes::random_pose(random, 100, 3);
    // Every third one lies between two coordinate axes, where the sign of a direction is a matter of rounding.
    if (i % 3 == 0) pose.rotation = quat_about(normalized(Vec3{1, i % 2 == 0 ? 1.0 : -1.0, 0}), 1.5707963267948966);
    TriangleMesh mesh = scenes::moved(straight, pose);
    for (Vec3& p : mesh.vertices)
      p = {static_cast<double>(static_cast<float>(p.x)), static_cast<double>(static_cast<float>(p.y)),
           static_cast<double>(static_cast<float>(p.z))};
    const std::vector<RevolutionAxis> axes = revolution_axes(mesh.vertices, mesh.faces);
    ASSERT_EQ(axes.size(), 1u) << i;
    EXPECT_NEAR(axes[0].turn, turn, 0.02 * turn) << i;
    EXPECT_LT(off(axes[0], pose.position), 1e-3) << i;
  }
}

TEST(RevolutionAxes, FindsAllAxesOfAMeshTheLargestFirst) {
  TriangleMesh mesh = scenes::tube(10, 6, 0, 20, 48, 3);
  const std::size_t first = mesh.vertices.size();
  const TriangleMesh other = scenes::moved(scenes::tube(3, 2, 0, 20, 24, 1), Pose{{40, 0, 0}, {}});
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (Face f : other.faces) {
    for (std::uint32_t& v : f.v) v += static_cast<std::uint32_t>(first);
    mesh.faces.push_back(f);
  }
  const std::vector<RevolutionAxis> axes = revolution_axes(mesh.vertices, mesh.faces);
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_GT(axes[0].turn, axes[1].turn);
  EXPECT_LT(off(axes[0], {0, 0, 5}), 1e-6);
  EXPECT_LT(off(axes[1], {40, 0, 5}), 1e-6);
}

TEST(CylinderParts, NumberEveryCylinderAndSkipFlatFaces) {
  std::mt19937_64 random(5);
  const Pose pose = scenes::random_pose(random, 30, 3);
  const TriangleMesh mesh = scenes::moved(scenes::tube(10, 6, -20, 20, 48, 3), pose);
  const std::vector<RevolutionAxis> axes = revolution_axes(mesh.vertices, mesh.faces);
  ASSERT_EQ(axes.size(), 1u);
  std::vector<std::uint8_t> parts;
  add_cylinder_parts(mesh.vertices, mesh.faces, axes, parts);
  ASSERT_EQ(parts.size(), mesh.faces.size());
  std::set<std::uint8_t> outside, inside;
  for (std::size_t f = 0; f < parts.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    const Vec3 normal = normalized(normal_unscaled(t)), middle = (1.0 / 3) * (t[0] + t[1] + t[2]) - axes[0].point;
    const double facing = dot(normal, normalized(middle - dot(middle, axes[0].direction) * axes[0].direction));
    if (std::abs(facing) < 0.5) {
      EXPECT_EQ(parts[f], 0) << f;
    } else {
      (facing > 0 ? outside : inside).insert(parts[f]);
    }
  }
  EXPECT_EQ(outside.size(), 1u);
  EXPECT_EQ(inside.size(), 1u);
  EXPECT_NE(outside, inside);
  EXPECT_FALSE(outside.count(0) || inside.count(0));
}

TEST(CylinderParts, KeepExistingNumbersAndSkipLessThanHalfACylinder) {
  TriangleMesh mesh = scenes::tube(10, 6, 0, 20, 48, 1);
  const std::vector<RevolutionAxis> axes = revolution_axes(mesh.vertices, mesh.faces);
  std::vector<std::uint8_t> parts(mesh.faces.size());
  parts[0] = 7;
  add_cylinder_parts(mesh.vertices, mesh.faces, axes, parts);
  EXPECT_EQ(parts[0], 7);
  EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 9);

  TriangleMesh third{mesh.vertices, {}};
  for (const Face& face : mesh.faces) {
    bool within = true;
    for (const std::uint32_t v : face.v)
      within &= mesh.vertices[v].x > 0.5 * std::hypot(mesh.vertices[v].x, mesh.vertices[v].y);
    if (within) third.faces.push_back(face);
  }
  parts.clear();
  add_cylinder_parts(third.vertices, third.faces, axes, parts);
  EXPECT_EQ(std::count(parts.begin(), parts.end(), 0), static_cast<std::ptrdiff_t>(third.faces.size()));
}

TEST(RevolutionAxes, FindsNoneWithoutSurfacesOfRevolution) {
  const TriangleMesh box = scenes::box({0, 0, 0}, {3, 4, 5});
  EXPECT_TRUE(revolution_axes(box.vertices, box.faces).empty());
  EXPECT_TRUE(revolution_axes({}, {}).empty());
}

}  // namespace
}  // namespace dismantle
