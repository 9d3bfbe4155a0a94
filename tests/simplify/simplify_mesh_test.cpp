// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/simplify_mesh.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dismantle {
namespace {

/// A closed torus about z.
TriangleMesh torus(double major, double minor, std::uint32_t around, std::uint32_t across) {
  TriangleMesh m;
  const double turn = 2 * std::acos(-1.0);
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const double u = turn * i / around, v = turn * k / across, r = major + minor * std::cos(v);
      m.vertices.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
      const std::uint32_t a = i * across + k, b = (i + 1) % around * across + k;
      const std::uint32_t c = (i + 1) % around * across + (k + 1) % across, d = i * across + (k + 1) % across;
      m.faces.push_back({{a, b, c}});
      m.faces.push_back({{a, c, d}});
    }
  }
  return m;
}

bool is_solid(const TriangleMesh& mesh) {
  const CleanedMesh cleaned = clean_mesh(mesh);
  return cleaned.faults.closed() && !cleaned.faults.inside_out && cleaned.mesh == mesh;
}

TEST(SimplifyMesh, ReachesTheTargetAndStaysASolid) {
  const TriangleMesh mesh = torus(20, 6, 64, 32);
  for (const std::size_t target : {2000u, 1000u, 400u, 150u}) {
    const TriangleMesh simple = simplify_mesh(mesh, {target});
    EXPECT_LE(simple.faces.size(), target);
    EXPECT_GE(simple.faces.size(), target * 9 / 10);
    EXPECT_TRUE(is_solid(simple)) << target;
  }
}

TEST(SimplifyMesh, KeepsAClosedMeshClosedForAnyTriangleCount) {
  for (const TriangleMesh& mesh : {torus(20, 6, 24, 12), scenes::tube(5, 3, 0, 10, 40, 8), scenes::tube(4, 0, 0, 1, 60),
                                   scenes::box({0, 0, 0}, {1, 2, 3})}) {
    for (const std::size_t target : {64u, 24u, 12u, 4u, 1u}) {
      const TriangleMesh simple = simplify_mesh(mesh, {target});
      EXPECT_TRUE(is_solid(simple)) << mesh.faces.size() << " to " << target;
      EXPECT_GE(simple.faces.size(), 4u);
    }
  }
}

TEST(SimplifyMesh, StopsAtTheErrorIfItIsReachedFirst) {
  const TriangleMesh mesh = torus(20, 6, 64, 32);
  const std::size_t fine = simplify_mesh(mesh, {10, 0.05}).faces.size();
  const std::size_t coarse = simplify_mesh(mesh, {10, 0.5}).faces.size();
  EXPECT_GT(fine, coarse);
  EXPECT_GT(coarse, 100u);
  EXPECT_LT(fine, mesh.faces.size());
}

TEST(SimplificationCurve, SaysWhatSimplifyMeshGives) {
  const TriangleMesh mesh = torus(20, 6, 32, 16);
  const std::vector<SimplificationStep> curve = simplification_curve(mesh);
  ASSERT_GT(curve.size(), 400u);
  EXPECT_EQ(curve.front().triangles, mesh.faces.size());
  for (std::size_t i = 1; i < curve.size(); ++i) {
    EXPECT_LT(curve[i].triangles, curve[i - 1].triangles);
    EXPECT_GE(curve[i].error, curve[i - 1].error);
  }
  EXPECT_EQ(simplify_mesh(mesh, {curve[200].triangles}).faces.size(), curve[200].triangles);
}

TEST(SimplifyMesh, AFlatFaceStaysExactlyFlat) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0.1, 10.3, 64, 12);
  for (const Vec3& v : simplify_mesh(mesh, {256}).vertices) EXPECT_TRUE(v.z == 0.1 || v.z == 10.3);
}

TEST(SimplifyMesh, KeepsVerticesOfTheOriginal) {
  const TriangleMesh mesh = torus(20, 6, 32, 16);
  for (const Vec3& v : simplify_mesh(mesh, {200}).vertices)
    EXPECT_NE(std::find(mesh.vertices.begin(), mesh.vertices.end(), v), mesh.vertices.end());
}

TEST(SimplifyMesh, DoesNothingIfTheMeshIsSmallEnough) {
  const TriangleMesh box = scenes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(simplify_mesh(box, {12}), box);
  EXPECT_EQ(simplify_mesh({}, {0}), TriangleMesh{});
}

TEST(SimplifyMesh, AnOpenMeshKeepsTriangles) {
  TriangleMesh sheet;
  for (int y = 0; y <= 20; ++y)
    for (int x = 0; x <= 20; ++x) sheet.vertices.push_back({x * 1.0, y * 1.0, std::sin(x * 0.3)});
  for (std::uint32_t y = 0; y < 20; ++y) {
    for (std::uint32_t x = 0; x < 20; ++x) {
      const std::uint32_t a = y * 21 + x;
      sheet.faces.push_back({{a, a + 1, a + 22}});
      sheet.faces.push_back({{a, a + 22, a + 21}});
    }
  }
  const TriangleMesh simple = simplify_mesh(sheet, {100});
  EXPECT_LE(simple.faces.size(), 110u);
  EXPECT_GT(simple.faces.size(), 10u);
}

}  // namespace
}  // namespace dismantle
