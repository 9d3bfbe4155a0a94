// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/winding_number.h"

#include "dismantle/surface/boundary_loops.h"
#include "tests/support/depth_oracle.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <array>

namespace dismantle {
namespace {

struct Shape {
  TriangleMesh mesh;
  SurfaceTree surface{mesh};
  WindingNumber winding{mesh, surface};
  explicit Shape(TriangleMesh m) : mesh(std::move(m)) {}
};

std::vector<TriangleMesh> meshes_with_and_without_faults() {
  const TriangleMesh tube = scenes::tube(5, 3, -4, 4, 17, 3);
  return {
      tube,
      scenes::inside_out(tube),
      scenes::without_face(tube, 7),
      scenes::without_face(scenes::without_face(tube, 50), 7),
      scenes::with_t_junction(tube, 20),
      scenes::torn_apart(scenes::box({-4, -3, -2}, {4, 3, 2})),
      scenes::joined(scenes::box({-5, -5, -5}, {5, 5, 5}), scenes::inside_out(scenes::box({-3, -3, -3}, {3, 3, 3}))),
      scenes::joined(scenes::box({-5, -5, -5}, {2, 2, 2}), scenes::box({-3, -3, -3}, {4, 4, 4})),
      scenes::sheet(4, 0)};
}

TEST(WindingNumber, IsThatOfTheSolidAnglesOfAllFaces) {
  std::mt19937_64 random(11);
  for (const TriangleMesh& mesh : meshes_with_and_without_faults()) {
    const Shape shape(scenes::moved(mesh, scenes::random_pose(random, 20, 3)));
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = shape.surface.bounds().center() + scenes::random_vector(random, 7);
      const double truth = oracle::winding_number(shape.mesh, p);
      EXPECT_NEAR(shape.winding.at(p), truth, 1e-9);
      EXPECT_EQ(shape.winding.inside(p), std::abs(truth) > 0.5);
    }
  }
}

TEST(WindingNumber, ChangesNoFasterThanItSays) {
  std::mt19937_64 random(12);
  for (const TriangleMesh& mesh : meshes_with_and_without_faults()) {
    const Shape shape(mesh);
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = scenes::random_vector(random, 7);
      const double radius = 0.999 * shape.surface.distance(p).distance;
      const double change = shape.winding.max_change(p, radius);
      for (int k = 0; k < 10; ++k) {
        const Vec3 q = p + radius * normalized(scenes::random_vector(random, 1));
        EXPECT_LE(std::abs(shape.winding.at(q) - shape.winding.at(p)), change + 1e-9);
      }
    }
  }
}

TriangleMesh without_faces(TriangleMesh mesh, std::initializer_list<std::size_t> from_the_last_on) {
  for (const std::size_t f : from_the_last_on) mesh = scenes::without_face(mesh, f);
  return mesh;
}

/// Holes that are small, long and narrow, torn, and bent: the fans of those without a side and a part of the next one
/// are bowls, from within which more than half of what can be seen is the fan.
std::vector<TriangleMesh> meshes_with_holes() {
  const TriangleMesh tube = scenes::tube(5, 3, -4, 4, 17, 3), strip = scenes::box({-5, -0.3, -0.2}, {5, 0.3, 0.2});
  const TriangleMesh box = scenes::box({-4, -3, -2}, {4, 3, 2}), cube = scenes::box({-3, -3, -3}, {3, 3, 3});
  return {without_faces(tube, {7}),          without_faces(tube, {50, 7}),
          scenes::torn_apart(box),           scenes::torn_apart(box, 0.5),
          without_faces(box, {3}),           without_faces(strip, {2}),
          without_faces(strip, {3, 2}),      scenes::sheet(4, 0),
          without_faces(cube, {6, 3, 2}),    without_faces(box, {7, 6, 3, 2}),
          without_faces(cube, {11, 7, 3, 2})};
}

TEST(WindingNumber, IsBoundedWhereAPointSeesTheSurfaceAndItsFansFromOutside) {
  std::mt19937_64 random(13);
  int near_half = 0, finite = 0;
  for (const TriangleMesh& mesh : meshes_with_holes()) {
    const Shape shape(mesh);
    ASSERT_FALSE(shape.winding.closed());
    for (int i = 0; i < 1500; ++i) {
      // Around a corner, near it or far, or anywhere.
      const Vec3 corner = i % 2 ? mesh.vertices[random() % mesh.vertices.size()] : Vec3{};
      const Vec3 center =
          corner + scenes::random_vector(random, i % 2 ? std::exp2(-static_cast<double>(i % 8)) * 8 : 4);
      const double clear =
          std::min(shape.surface.distance(center).distance, shape.winding.fans()->distance(center).distance);
      const double radius = i % 3 == 0 ? 0.05 * clear : 0.999 * clear;
      const double bound = shape.winding.bound_outside_fans(center, radius);
      if (bound > 1) continue;
      ++finite;
      for (int k = 0; k < 8; ++k) {
        const Vec3 q = center + radius * normalized(scenes::random_vector(random, 1));
        const double winding = std::abs(oracle::winding_number(mesh, q));
        ASSERT_LE(winding, bound + 1e-9) << "point " << i << " of a mesh of " << mesh.faces.size();
        near_half += winding > 0.4;
      }
    }
  }
  EXPECT_GT(finite, 3000);
  EXPECT_GT(near_half, 100);
}

TEST(WindingNumber, TellsTheSideOfPointsNearHoles) {
  std::mt19937_64 random(14);
  for (const TriangleMesh& mesh : meshes_with_holes()) {
    const Shape shape(mesh);
    for (int i = 0; i < 600; ++i) {
      const Vec3 corner = mesh.vertices[random() % mesh.vertices.size()];
      const Vec3 p = corner + scenes::random_vector(random, std::exp2(-static_cast<double>(i % 8)) * 8);
      const double truth = std::abs(oracle::winding_number(mesh, p));
      if (std::abs(truth - 0.5) <= 1e-9) continue;
      EXPECT_EQ(shape.winding.inside(p), truth > 0.5) << truth;
    }
  }
}

TEST(WindingNumber, IsAnIntegerWithCracksAndNotWithHoles) {
  const TriangleMesh box = scenes::box({-4, -3, -2}, {4, 3, 2});
  EXPECT_TRUE(Shape(box).winding.closed());
  EXPECT_TRUE(Shape(scenes::with_t_junction(box, 3)).winding.closed());
  EXPECT_TRUE(Shape(scenes::inside_out(box)).winding.closed());
  EXPECT_FALSE(Shape(scenes::without_face(box, 3)).winding.closed());
  EXPECT_FALSE(Shape(scenes::torn_apart(box)).winding.closed());
}

TEST(WindingNumber, IsContinuousInThePlaneOfAHole) {
  const Shape shape(scenes::without_face(scenes::without_face(scenes::box({0, 0, 0}, {4, 4, 4}), 2), 2));
  for (const Vec3 p : {Vec3{1, 2, 4}, Vec3{2, 2, 4}, Vec3{3.5, 3.5, 4}, Vec3{2, 2, 4 + 1e-13}})
    EXPECT_NEAR(shape.winding.at(p), oracle::winding_number(shape.mesh, p), 1e-6);
}

TEST(BoundaryLoops, AreTheClosedWalksOfEdgesInExcess) {
  const TriangleMesh box = scenes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(boundary_loops(box).empty());
  EXPECT_EQ(boundary_loops(scenes::without_face(box, 0)).size(), 1u);
  EXPECT_EQ(boundary_loops(scenes::without_face(box, 0)).front().size(), 3u);
  EXPECT_EQ(boundary_loops(scenes::torn_apart(box)).size(), 12u);
  TriangleMesh twice = box;
  twice.faces.push_back(twice.faces.front());
  EXPECT_EQ(boundary_loops(twice).size(), 1u);
  TriangleMesh touching;  // two triangles with a common vertex
  touching.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  touching.faces = {{{0, 1, 2}}, {{0, 3, 4}}};
  EXPECT_EQ(boundary_loops(touching).size(), 2u);
}

/// One face divided into four, but not its neighbours; new vertices are off the edges by `offset`.
TriangleMesh with_divided_face(TriangleMesh mesh, double offset) {
  const Face whole = mesh.faces.back();
  mesh.faces.pop_back();
  std::array<std::uint32_t, 3> middle;
  for (std::size_t i = 0; i < 3; ++i) {
    middle[i] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back((mesh.vertices[whole.v[i]] + mesh.vertices[whole.v[(i + 1) % 3]]) / 2 +
                            Vec3{offset, offset, offset});
  }
  for (std::size_t i = 0; i < 3; ++i) mesh.faces.push_back({{whole.v[i], middle[i], middle[(i + 2) % 3]}});
  mesh.faces.push_back({{middle[0], middle[1], middle[2]}});
  return mesh;
}

TEST(BoundaryLoops, AreNarrowAroundAFaceThatIsDividedUnlikeItsNeighbours) {
  const TriangleMesh mesh = with_divided_face(scenes::box({0, 0, 0}, {1, 1, 1}), 0);
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), 3u);
  for (const auto& loop : loops) EXPECT_EQ(loop.size(), 3u);
}

TEST(WindingNumber, TakesRoundedTJunctionsAsClosed) {
  const TriangleMesh box = scenes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(Shape(with_divided_face(box, 1e-7)).winding.closed());
  EXPECT_FALSE(Shape(with_divided_face(box, 1e-4)).winding.closed());
}

}  // namespace
}  // namespace dismantle
