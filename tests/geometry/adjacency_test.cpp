// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/adjacency.h"

#include "tests/support/faulty_meshes.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
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

/// A box whose face 0 is cut in two at the midpoint of its first edge, moved by `aside`: its neighbour keeps the whole
/// edge.
TriangleMesh cracked_box(double aside) {
  TriangleMesh mesh = scenes::box({0, 0, 0}, {10, 20, 30});
  const Face f = mesh.faces[0];
  const Triangle t = mesh.triangle(0);
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (t[0] + t[1]) + aside * normalized(normal_unscaled(t)));
  mesh.faces[0] = {{f.v[0], middle, f.v[2]}};
  mesh.faces.push_back({{middle, f.v[1], f.v[2]}});
  return mesh;
}

TEST(Adjacency, DistinguishesCracksFromOpenings) {
  EXPECT_EQ(edge_faults(cracked_box(0)).boundary, 3u);
  EXPECT_EQ(edge_faults(cracked_box(0)).open, 0u);
  EXPECT_EQ(edge_faults(cracked_box(1e-5)).open, 0u);
  EXPECT_EQ(edge_faults(cracked_box(1e-2)).open, 3u);

  TriangleMesh open = scenes::box({0, 0, 0}, {1, 1, 1});
  open.faces.pop_back();
  EXPECT_EQ(edge_faults(open).open, 3u);
  TriangleMesh flipped = scenes::box({0, 0, 0}, {1, 1, 1});
  std::swap(flipped.faces[0].v[1], flipped.faces[0].v[2]);
  EXPECT_EQ(edge_faults(flipped).misoriented, 3u);
  EXPECT_EQ(edge_faults(flipped).open, 3u);
}

TEST(Adjacency, FindsTheCracksOfAFineMeshThatIsTornApart) {
  TriangleMesh torn = scenes::torn_apart(scenes::tube(10, 6, 0, 20, 200, 20));
  ASSERT_GT(torn.vertices.size(), 50'000u);
  EXPECT_EQ(edge_faults(torn).boundary, torn.vertices.size());
  EXPECT_EQ(edge_faults(torn).open, 0u);
  torn.faces.erase(torn.faces.begin() + 1000);
  EXPECT_EQ(edge_faults(torn).open, 3u);
}

TEST(Adjacency, FindsLongEdgesAmongShortOnes) {
  // One side of the crack is an edge, the other a hundred short ones; beside it, the mesh is fine.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {100, 90, 80}, {0, 50, 0}};
  mesh.faces = {{{0, 1, 2}}};
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = (i / 100.0) * mesh.vertices[1], b = ((i + 1) / 100.0) * mesh.vertices[1];
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& p : {a, b, Vec3{50, -50, 0}}) mesh.vertices.push_back(p);
    mesh.faces.push_back({{first + 1, first, first + 2}});
  }
  const EdgeFaults faults = edge_faults(clean_mesh(mesh).mesh);
  EXPECT_EQ(faults.boundary, 105u);
  EXPECT_EQ(faults.open, 4u);  // the outline
}

/// The open edges by definition, for meshes in pieces: every edge against every other.
std::size_t open_edges_of_pieces(const TriangleMesh& mesh) {
  const double width = 1e-4 * diagonal(bounds(mesh));
  std::size_t open = 0;
  const auto covered = [&](const Vec3& p, const Vec3& along) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const Triangle t = mesh.triangle(f);
      for (int k = 0; k < 3; ++k) {
        const Vec3 a = t[k], edge = t[(k + 1) % 3] - a;
        const double s = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
        if (dot(edge, along) < 0 && length(p - (a + s * edge)) <= width) return true;
      }
    }
    return false;
  };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = t[k], b = t[(k + 1) % 3];
      open += !covered(a, b - a) || !covered(0.5 * (a + b), b - a) || !covered(b, b - a) ? 1 : 0;
    }
  }
  return open;
}

TEST(Adjacency, FindsTheOpenEdgesOfRandomMeshesInPieces) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0, 1);
  std::size_t open = 0, closed = 0;
  for (int round = 0; round < 60; ++round) {
    // Some cracks are just narrow enough and some just too wide; a few faces are missing.
    TriangleMesh mesh =
        scenes::torn_apart(scenes::tube(10, 4 * any(random), any(random), 12, 5 + round % 20, 1 + round % 7),
                           std::pow(10, -4 + 2 * any(random)));
    const Pose pose{{100 * any(random), -50, 3},
                    quat_about(normalized(Vec3{any(random), 1, any(random)}), 6 * any(random))};
    mesh = scenes::moved(mesh, pose);
    for (int k = 0; k < round % 3; ++k) mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(k));
    const std::size_t expected = open_edges_of_pieces(mesh);
    EXPECT_EQ(edge_faults(mesh).open, expected) << round;
    (expected > 0 ? open : closed) += 1;
  }
  EXPECT_GT(open, 10u);
  EXPECT_GT(closed, 10u);
}

/// Long edges in all directions: an amount of work that is quadratic without a limit.
TEST(Adjacency, CallsHostileMeshesOpenInTime) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  TriangleMesh mesh;
  for (std::uint32_t f = 0; f < 50'000; ++f) {
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back({any(random), any(random), any(random)});
    mesh.faces.push_back({{3 * f, 3 * f + 1, 3 * f + 2}});
  }
  EXPECT_GT(edge_faults(mesh).open, 140'000u);
}

TEST(Adjacency, CallsARolledSheetOpenThoughItsSlitIsClosed) {
  // Only a tube's outside, each strip with separate vertices: all seams are cracks, only its two ends are open.
  TriangleMesh sheet;
  for (int k = 0; k < 12; ++k) {
    const auto at = [](int i, double z) {
      return Vec3{std::cos(i % 12 * std::acos(-1) / 6), std::sin(i % 12 * std::acos(-1) / 6), z};
    };
    const auto first = static_cast<std::uint32_t>(sheet.vertices.size());
    for (const Vec3 p : {at(k, 0), at(k + 1, 0), at(k + 1, 2), at(k, 2)}) sheet.vertices.push_back(p);
    sheet.faces.push_back({{first, first + 1, first + 2}});
    sheet.faces.push_back({{first, first + 2, first + 3}});
  }
  EXPECT_EQ(edge_faults(sheet).open, 24u);
}

TEST(Adjacency, FindsNoOpeningAtAnEdgeSharedByTwoSolids) {
  TriangleMesh mesh = scenes::box({0, 0, 0}, {1, 1, 1});
  const TriangleMesh other = scenes::box({1, 1, 0}, {2, 2, 1});
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Face& f : other.faces) mesh.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
  const CleanedMesh cleaned = clean_mesh(mesh);
  EXPECT_EQ(cleaned.faults.nonmanifold_edges, 1u);
  EXPECT_FALSE(cleaned.faults.closed());
  EXPECT_TRUE(cleaned.faults.bounds_solid());
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
