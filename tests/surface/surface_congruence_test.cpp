// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/surface_congruence.h"

#include "tests/support/meshes.h"
#include "tests/support/puzzle_scenes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dismantle {
namespace {

constexpr double kWithin = 0.01;

std::optional<RigidTransform> compared(const TriangleMesh& a, const TriangleMesh& b, double within = kWithin) {
  return surface_congruence(ComparedSurface(a), ComparedSurface(b), within);
}

/// The same surface with some of its faces divided in three.
TriangleMesh divided(TriangleMesh mesh, std::mt19937_64& random) {
  const std::size_t count = mesh.faces.size();
  for (std::size_t f = 0; f < count; ++f) {
    if (random() % 3 == 0) continue;
    const Face face = mesh.faces[f];
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    const Triangle t = mesh.triangle(f);
    mesh.vertices.push_back((t[0] + t[1] + t[2]) / 3);
    mesh.faces[f] = {{face.v[0], face.v[1], middle}};
    mesh.faces.push_back({{face.v[1], face.v[2], middle}});
    mesh.faces.push_back({{face.v[2], face.v[0], middle}});
  }
  return mesh;
}

TriangleMesh mirrored(TriangleMesh mesh) {
  for (Vec3& p : mesh.vertices) p.x = -p.x;
  for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  return mesh;
}

/// An L with a foot: it has no symmetry.
TriangleMesh bracket(double foot = 4) {
  return scenes::box_block({{{0, 2, 10}, {0, 3, 12}, {0, foot, 9}}},
                           [](int i, int j, int k) { return i == 0 || (j == 0 && k == 0); });
}

TEST(SurfaceCongruence, IsFoundWhateverTheVerticesOnTheFaces) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20; ++i) {
    const Pose pose = scenes::random_pose(random, 30, 3);
    for (const TriangleMesh& mesh :
         {bracket(), scenes::tube(3, 1, 0, 5, 40), scenes::tube(3, 0, 0, 5, 6), scenes::box({0, 0, 0}, {3, 3, 3})}) {
      const TriangleMesh other = scenes::moved(divided(mesh, random), pose);
      const auto motion = compared(divided(mesh, random), other);
      ASSERT_TRUE(motion) << i;
      const SurfaceTree tree(other);
      for (const Vec3& p : mesh.vertices) EXPECT_LE(tree.distance(*motion * p).distance, kWithin);
    }
  }
}

TEST(SurfaceCongruence, OfARoundSurfaceDoesNotDependOnWhereItsFacetsBegin) {
  const TriangleMesh nut = scenes::tube(3, 1, 0, 5, 120, 1);
  const TriangleMesh turned = scenes::moved(scenes::tube(3, 1, 0, 5, 120, 3), {{}, quat_about({0, 0, 1}, 0.02)});
  EXPECT_TRUE(compared(nut, turned));
}

TEST(SurfaceCongruence, TellsMirrorImagesAndOtherShapesApart) {
  std::mt19937_64 random(6);
  const TriangleMesh a = divided(bracket(), random);
  EXPECT_TRUE(compared(a, divided(bracket(), random)));
  EXPECT_FALSE(compared(a, divided(mirrored(bracket()), random)));
  EXPECT_FALSE(compared(a, bracket(4.05)));
  // A cube's size is the same with a pin of 1 on another side of a face.
  const auto pinned = [](double at) {
    return scenes::box_block({{{0, 4, 5, 10}, {0, at, at + 1, 10}, {0, 10, 12}}},
                             [](int i, int j, int k) { return k == 0 || (i == 1 && j == 1); });
  };
  EXPECT_TRUE(compared(pinned(3), divided(pinned(3), random)));
  EXPECT_FALSE(compared(pinned(3), pinned(3.1)));
}

TEST(SurfaceCongruence, TellsDiametersApartThatDifferByMoreThanTessellationsDo) {
  EXPECT_FALSE(compared(scenes::tube(3, 0, 0, 20, 64), scenes::tube(3.002, 0, 0, 20, 64)));
  EXPECT_TRUE(compared(scenes::tube(3, 0, 0, 20, 64), scenes::tube(3.00005, 0, 0, 20, 64, 3)));
}

TEST(SurfaceCongruence, IsNotFoundOfSurfacesOnALine) {
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{{0, 1, 2}}}};
  EXPECT_FALSE(compared(flat, flat));
}

}  // namespace
}  // namespace dismantle
