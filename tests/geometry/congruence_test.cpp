// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/congruence.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace dismantle {
namespace {

Pose random_pose(std::mt19937& random, double reach) {
  std::normal_distribution<double> normal;
  const Quat q{normal(random), normal(random), normal(random), normal(random)};
  return {{reach * normal(random), reach * normal(random), reach * normal(random)}, normalized(q)};
}

/// The mesh with its vertices and faces in another order, and each face beginning at another corner.
TriangleMesh shuffled(const TriangleMesh& mesh, std::mt19937& random) {
  std::vector<std::uint32_t> place(mesh.vertices.size());
  std::iota(place.begin(), place.end(), 0u);
  std::shuffle(place.begin(), place.end(), random);
  TriangleMesh other = mesh;
  for (std::size_t v = 0; v < place.size(); ++v) other.vertices[place[v]] = mesh.vertices[v];
  for (Face& f : other.faces) {
    f = {{place[f.v[0]], place[f.v[1]], place[f.v[2]]}};
    std::rotate(f.v, f.v + random() % 3, f.v + 3);
  }
  std::shuffle(other.faces.begin(), other.faces.end(), random);
  return other;
}

/// Coordinates as a file of six significant digits keeps them.
TriangleMesh rounded(TriangleMesh mesh) {
  for (Vec3& p : mesh.vertices)
    for (int i = 0; i < 3; ++i) {
      if (p[i] == 0) continue;
      const double unit = std::pow(10, std::floor(std::log10(std::abs(p[i]))) - 5);
      p[i] = std::round(p[i] / unit) * unit;
    }
  return mesh;
}

TriangleMesh mirrored(TriangleMesh mesh) {
  for (Vec3& p : mesh.vertices) p.x = -p.x;
  for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  return mesh;
}

/// A box with a corner pulled out, which has no symmetry.
TriangleMesh skewed() {
  TriangleMesh mesh = scenes::box({0, 0, 0}, {3, 5, 9});
  mesh.vertices.back() += Vec3{0.7, 1.1, 0.4};
  mesh.vertices.front() += Vec3{-0.5, 0.2, 0};
  return mesh;
}

TEST(Congruence, FindsTheMotionOfAMovedShuffledRoundedMesh) {
  std::mt19937 random(20261125);
  const TriangleMesh shapes[] = {skewed(), scenes::box({0, 0, 0}, {4, 4, 4}), scenes::tube(5, 2, 0, 30, 48, 3),
                                 scenes::tube(1, 0, 0, 400, 32), scenes::tube(50, 49.5, 0, 0.2, 90)};
  for (const TriangleMesh& shape : shapes)
    for (int round = 0; round < 20; ++round) {
      const TriangleMesh other = rounded(shuffled(scenes::moved(shape, random_pose(random, 60)), random));
      const std::optional<RigidTransform> motion = congruence(rounded(shape), other);
      ASSERT_TRUE(motion.has_value()) << "round " << round;
      EXPECT_NEAR(determinant(motion->rotation), 1, 1e-9);
      for (const Vec3& p : shape.vertices) {
        double nearest = 1e9;
        for (const Vec3& q : other.vertices) nearest = std::min(nearest, length(*motion * p - q));
        EXPECT_LT(nearest, 2 * kCongruenceTolerance * 500);
      }
    }
}

TEST(Congruence, TellsMirrorImagesApart) {
  std::mt19937 random(7);
  EXPECT_FALSE(congruence(skewed(), mirrored(skewed())));
  EXPECT_FALSE(congruence(skewed(), scenes::moved(mirrored(skewed()), random_pose(random, 10))));
  EXPECT_TRUE(congruence(scenes::tube(5, 2, 0, 30, 48), mirrored(scenes::tube(5, 2, 0, 30, 48))))
      << "a tube is its own mirror image";
}

TEST(Congruence, SeesSmallDifferences) {
  const TriangleMesh tube = scenes::tube(5, 2, 0, 30, 48);
  EXPECT_FALSE(congruence(tube, scenes::tube(5, 2, 0, 30.01, 48)));
  EXPECT_FALSE(congruence(tube, scenes::tube(5, 2.01, 0, 30, 48)));
  for (std::size_t v = 0; v < tube.vertices.size(); v += 5) {
    TriangleMesh dented = tube;
    dented.vertices[v] += Vec3{0.01, 0, 0.01};
    EXPECT_FALSE(congruence(tube, dented)) << v;
    EXPECT_FALSE(congruence(dented, tube)) << v;
  }
}

TEST(Congruence, AllowsPlanePolygonsToBeDividedInOtherWays) {
  TriangleMesh box = scenes::box({0, 0, 0}, {3, 5, 9}), other = box;
  // The two triangles of one side, with the other diagonal.
  const Face a = box.faces[0], b = box.faces[1];
  std::vector<std::uint32_t> corners(a.v, a.v + 3);
  for (const std::uint32_t v : b.v)
    if (std::find(a.v, a.v + 3, v) == a.v + 3) corners.push_back(v);
  const auto in_b = [&](std::uint32_t v) { return std::find(b.v, b.v + 3, v) != b.v + 3; };
  int lone = 0;
  while (in_b(a.v[lone])) ++lone;
  const std::uint32_t p = a.v[lone], q = a.v[(lone + 1) % 3], r = a.v[(lone + 2) % 3], far = corners[3];
  other.faces[0] = {{p, q, far}};
  other.faces[1] = {{p, far, r}};
  EXPECT_TRUE(congruence(box, other));
  box.vertices[far] += Vec3{0.02, 0.03, 0.05};
  other.vertices[far] += Vec3{0.02, 0.03, 0.05};
  EXPECT_FALSE(congruence(box, other)) << "no plane: a ridge is no valley";
  TriangleMesh inside_out = box;
  for (Face& f : inside_out.faces) std::swap(f.v[1], f.v[2]);
  EXPECT_FALSE(congruence(box, inside_out));
}

TEST(Congruence, IsFoundForNothingEmpty) {
  EXPECT_FALSE(congruence(TriangleMesh{}, scenes::box({0, 0, 0}, {1, 1, 1})));
}

}  // namespace
}  // namespace dismantle
