// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/triangle_mesh.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(CleanMesh, WeldsATriangleSoupIntoAClosedBox) {
  const TriangleMesh box = scenes::box({-1, -1, -1}, {1, 1, 1});
  TriangleMesh soup;
  for (std::uint32_t f = 0; f < box.faces.size(); ++f) {
    for (const std::uint32_t v : box.faces[f].v) soup.vertices.push_back(box.vertices[v]);
    soup.faces.push_back({{3 * f, 3 * f + 1, 3 * f + 2}});
  }
  const CleanedMesh cleaned = clean_mesh(soup);
  EXPECT_EQ(cleaned.mesh.vertices.size(), 8u);
  EXPECT_EQ(cleaned.mesh.faces.size(), 12u);
  EXPECT_EQ(cleaned.faults.welded_vertices, 28u);
  EXPECT_TRUE(cleaned.faults.closed());
  EXPECT_FALSE(cleaned.faults.inside_out);
  EXPECT_DOUBLE_EQ(signed_volume(cleaned.mesh), 8);
}

TEST(CleanMesh, WeldsPositiveAndNegativeZero) {
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}};
  mesh.faces = {{{0, 1, 2}}, {{3, 2, 1}}};
  EXPECT_EQ(clean_mesh(mesh).mesh.vertices.size(), 3u);
}

TEST(CleanMesh, DropsAndCountsDegenerateTriangles) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  mesh.faces = {{{0, 1, 2}}, {{0, 0, 3}}, {{0, 1, 3}}};
  const CleanedMesh cleaned = clean_mesh(mesh);
  EXPECT_EQ(cleaned.faults.degenerate_faces, 2u);
  EXPECT_EQ(cleaned.mesh.faces.size(), 1u);
  EXPECT_EQ(cleaned.mesh.vertices.size(), 3u);
}

TEST(CleanMesh, ReportsASolidTurnedInsideOut) {
  TriangleMesh mesh = scenes::box({0, 0, 0}, {1, 1, 1});
  for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  EXPECT_TRUE(clean_mesh(mesh).faults.inside_out);
}

}  // namespace
}  // namespace dismantle
