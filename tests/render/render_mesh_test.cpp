// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/render_mesh.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(RenderMesh, ABoxHasItsTwelveEdgesAndFlatFaces) {
  const RenderMesh m = make_render_mesh(scenes::box({0, 0, 0}, {1, 2, 3}));
  EXPECT_EQ(m.feature_edges.size(), 12u);
  for (std::size_t f = 0; f < m.mesh.faces.size(); ++f) {
    const Vec3 n = normalized(normal_unscaled(m.mesh.triangle(f)));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f c = m.corner_normals[3 * f + k];
      EXPECT_NEAR(dot(n, Vec3{c.x, c.y, c.z}), 1, 1e-6);
    }
  }
}

TEST(RenderMesh, ACylinderIsSmoothAroundAndHasTwoRims) {
  const RenderMesh m = make_render_mesh(scenes::tube(5, 0, 0, 10, 40));
  EXPECT_EQ(m.feature_edges.size(), 80u);
  for (std::size_t f = 0; f < m.mesh.faces.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f n = m.corner_normals[3 * f + k];
      if (std::abs(n.z) > 0.5f) continue;  // a lid
      const Vec3 p = m.mesh.triangle(f)[static_cast<int>(k)];
      EXPECT_NEAR((n.x * p.x + n.y * p.y) / 5, 1, 5e-3);  // radial, although the facets are flat
    }
  }
}

TEST(RenderMesh, TheBorderOfAnOpenMeshIsAFeature) {
  TriangleMesh m;
  m.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  m.faces = {{{0, 1, 2}}, {{0, 2, 3}}};
  EXPECT_EQ(make_render_mesh(m).feature_edges.size(), 4u);  // not the diagonal
}

}  // namespace
}  // namespace dismantle
