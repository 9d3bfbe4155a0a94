// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/vertex_regions.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <vector>

namespace dismantle {
namespace {

AssemblyTriangles triangles_of(TriangleMesh mesh) {
  return make_assembly_triangles(scenes::assembly({scenes::component("solid", std::move(mesh))}), {});
}

TEST(VertexRegions, ConnectVerticesThroughTrianglesThatAreNotCut) {
  const AssemblyTriangles box = triangles_of(scenes::box({0, 0, 0}, {1, 1, 1}));
  std::vector<NodeIndex> across;
  for (NodeIndex leaf = 0; leaf < box.faces.size(); ++leaf) {
    const Face& f = box.faces[leaf];
    const double z[3] = {box.vertices[f.v[0]].z, box.vertices[f.v[1]].z, box.vertices[f.v[2]].z};
    if (z[0] != z[1] || z[0] != z[2]) across.push_back(leaf);
  }
  ASSERT_EQ(across.size(), 8u);

  VertexRegions whole(box, ComponentId(0)), cut(box, ComponentId(0), across);
  for (std::uint32_t a = 0; a < 8; ++a) {
    for (std::uint32_t b = 0; b < 8; ++b) {
      EXPECT_EQ(whole.region_of(a), whole.region_of(b));
      EXPECT_EQ(cut.region_of(a) == cut.region_of(b), box.vertices[a].z == box.vertices[b].z);
    }
  }
}

TEST(ShellVertices, GiveOneVertexOfEachConnectedPart) {
  TriangleMesh mesh = scenes::box({0, 0, 0}, {1, 1, 1});
  const TriangleMesh second = scenes::box({5, 0, 0}, {6, 1, 1});
  for (const Vec3& p : second.vertices) mesh.vertices.push_back(p);
  for (const Face& f : second.faces) mesh.faces.push_back({{f.v[0] + 8, f.v[1] + 8, f.v[2] + 8}});
  const AssemblyTriangles solid = triangles_of(std::move(mesh));
  const std::vector<std::uint32_t> shells = shell_vertices(solid, ComponentId(0));
  ASSERT_EQ(shells.size(), 2u);
  EXPECT_NE(solid.vertices[shells[0]].x > 3, solid.vertices[shells[1]].x > 3);
}

}  // namespace
}  // namespace dismantle
