// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/edge_collapse.h"

#include "dismantle/geometry/adjacency.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

TEST(Quadric, IsTheSumOfSquaredDistancesToItsPlanes) {
  Quadric q = plane_quadric({0, 0, 1}, {5, 6, 2}, 1);
  q += plane_quadric({1, 0, 0}, {3, 9, 9}, 2);
  EXPECT_DOUBLE_EQ(evaluate(q, {3, 7, 2}), 0);
  EXPECT_DOUBLE_EQ(evaluate(q, {4, 7, 5}), 9 + 2 * 1);
}

TEST(EdgeCollapse, KeepsASolidClosedAfterEverySingleCollapse) {
  for (const TriangleMesh& mesh :
       {scenes::tube(5, 3, 0, 10, 12, 2), scenes::tube(4, 0, 0, 3, 16, 2), scenes::box({0, 0, 0}, {3, 2, 1})}) {
    EdgeCollapse collapse(mesh);
    double error = 0;
    while (collapse.step()) {
      const CleanedMesh now = clean_mesh(collapse.mesh());
      ASSERT_TRUE(now.faults.closed()) << collapse.face_count();
      ASSERT_EQ(now.faults.degenerate_faces, 0u);
      ASSERT_EQ(now.mesh.faces.size(), collapse.face_count());
      ASSERT_GE(collapse.error(), error);
      error = collapse.error();
    }
    EXPECT_LT(collapse.face_count(), 40u);
    EXPECT_GE(collapse.face_count(), 4u);
  }
}

TEST(EdgeCollapse, ATubeKeepsItsHole) {
  EdgeCollapse collapse(scenes::tube(5, 3, 0, 10, 24, 4));
  while (collapse.step()) {
  }
  // Vertices - edges + faces of a closed surface: 2 for a sphere, 0 for a torus.
  const TriangleMesh mesh = collapse.mesh();
  EXPECT_EQ(2 * mesh.vertices.size(), mesh.faces.size());
}

TEST(EdgeCollapse, TakesWhatCostsNothingFirst) {
  EdgeCollapse collapse(scenes::tube(5, 3, 0, 10, 16, 8));  // seven rings of redundant vertices
  while (collapse.face_count() > 4 * 2 * 16 && collapse.step()) {
  }
  EXPECT_EQ(collapse.face_count(), 4u * 2 * 16);
  EXPECT_LT(collapse.error(), 1e-6);
}

TEST(EdgeCollapse, StopsAtTheErrorLimit) {
  EdgeCollapse collapse(scenes::tube(5, 3, 0, 10, 16, 8));
  while (collapse.step(0.5)) {
  }
  EXPECT_LE(collapse.error(), 0.5);
  EXPECT_TRUE(collapse.step());
  EXPECT_GT(collapse.error(), 0.5);
}

TEST(EdgeCollapse, ABorderKeepsItsShapeAndStaysABorder) {
  TriangleMesh sheet;  // 8 x 8 squares, flat
  for (int y = 0; y <= 8; ++y)
    for (int x = 0; x <= 8; ++x) sheet.vertices.push_back({x * 1.0, y * 1.0, 0});
  for (std::uint32_t y = 0; y < 8; ++y) {
    for (std::uint32_t x = 0; x < 8; ++x) {
      const std::uint32_t a = y * 9 + x;
      sheet.faces.push_back({{a, a + 1, a + 10}});
      sheet.faces.push_back({{a, a + 10, a + 9}});
    }
  }
  EdgeCollapse collapse(sheet);
  while (collapse.step(1e-6)) {
  }
  const TriangleMesh mesh = collapse.mesh();
  double area = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) area += length(normal_unscaled(mesh.triangle(f))) / 2;
  EXPECT_LE(mesh.faces.size(), 6u);
  EXPECT_EQ(bounds(mesh), bounds(sheet));
  EXPECT_DOUBLE_EQ(area, 64);
  EXPECT_EQ(edge_faults(mesh).nonmanifold, 0u);
}

TEST(EdgeCollapse, VerticesOfNonManifoldEdgesDoNotMove) {
  TriangleMesh mesh = scenes::tube(5, 0, 0, 10, 24, 6);  // with a fin on one of its edges
  const auto fin = static_cast<std::uint32_t>(mesh.vertices.size());
  const Face edge = mesh.faces[0];
  mesh.vertices.push_back({20, 0, 0});
  mesh.faces.push_back({{edge.v[0], edge.v[1], fin}});
  EdgeCollapse collapse(mesh);
  while (collapse.step()) {
  }
  const TriangleMesh simple = collapse.mesh();
  for (const std::uint32_t v : {edge.v[0], edge.v[1]})
    EXPECT_NE(std::find(simple.vertices.begin(), simple.vertices.end(), mesh.vertices[v]), simple.vertices.end());
}

}  // namespace
}  // namespace dismantle
