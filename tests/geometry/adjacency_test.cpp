// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/adjacency.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace dismantle {
namespace {

TEST(Adjacency, FindsNoFaultInClosedMeshes) {
  for (const TriangleMesh& mesh :
       {scenes::box({0, 0, 0}, {1, 2, 3}), scenes::tube(2, 1, 0, 5, 12, 3), scenes::tube(2, 0, 0, 5, 12)}) {
    const EdgeFaults faults = edge_faults(mesh);
    EXPECT_EQ(faults.boundary, 0u);
    EXPECT_EQ(faults.nonmanifold, 0u);
    EXPECT_EQ(faults.misoriented, 0u);
    EXPECT_GT(signed_volume(mesh), 0);
  }
}

TEST(Adjacency, CountsBoundaryNonManifoldAndMisorientedEdges) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  mesh.faces = {{{0, 1, 2}}, {{0, 1, 3}}};
  EXPECT_EQ(edge_faults(mesh).misoriented, 1u);
  EXPECT_EQ(edge_faults(mesh).boundary, 4u);
  mesh.faces.push_back({{1, 0, 4}});
  EXPECT_EQ(edge_faults(mesh).nonmanifold, 1u);
}

TEST(Adjacency, GivesEveryVertexAndEdgeExactlyOneRepresentative) {
  const TriangleMesh mesh = scenes::tube(2, 1, 0, 5, 12, 3);
  const std::vector<std::uint8_t> features = representative_features(mesh);
  std::vector<int> vertex_count(mesh.vertices.size(), 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edge_count;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.faces[f].v[k], b = mesh.faces[f].v[(k + 1) % 3];
      vertex_count[a] += features[f] >> k & 1;
      edge_count[std::minmax(a, b)] += features[f] >> (3 + k) & 1;
    }
  }
  for (const int count : vertex_count) EXPECT_EQ(count, 1);
  EXPECT_EQ(edge_count.size(), mesh.faces.size() * 3 / 2);
  for (const auto& [edge, count] : edge_count) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace dismantle
