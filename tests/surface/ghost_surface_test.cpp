// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/ghost_surface.h"

#include "tests/support/meshes.h"
#include "tests/support/swept_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>

namespace dismantle {
namespace {

constexpr double kLength = 0.01;

/// The least and the greatest distance by which the faces' planes are retracted at their corners.
std::pair<double, double> retraction(const TriangleMesh& mesh, const std::vector<Vec3>& ghost) {
  double least = 1e9, greatest = -1e9;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 normal = normalized(normal_unscaled(mesh.triangle(f)));
    for (const std::uint32_t v : mesh.faces[f].v) {
      const double by = dot(normal, mesh.vertices[v] - ghost[v]);
      least = std::min(least, by);
      greatest = std::max(greatest, by);
    }
  }
  return {least, greatest};
}

TEST(GhostSurface, RetractsEveryFaceAndDisplacesNoVertexFurtherThanAllowed) {
  for (const TriangleMesh& mesh : {scenes::box({0, 0, 0}, {4, 5, 6}), scenes::tube(5, 3, 0, 10, 48, 4)}) {
    const std::vector<Vec3> ghost = ghost_vertices(mesh.vertices, mesh.faces, kLength);
    for (std::size_t v = 0; v < ghost.size(); ++v)
      EXPECT_LE(length(ghost[v] - mesh.vertices[v]), kLength * (1 + 1e-12));
    const auto [least, greatest] = retraction(mesh, ghost);
    EXPECT_GE(least, kLength / std::sqrt(3.0) * (1 - 1e-9)) << "at the corners of a box";
    EXPECT_LE(greatest, kLength / std::sqrt(2.0) * (1 + 1e-9));
  }
}

TEST(GhostSurface, KeepsCylindersAndFlatFacesWhatTheyAre) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 10, 48, 4);
  const std::vector<Vec3> ghost = ghost_vertices(mesh.vertices, mesh.faces, kLength);
  const auto [least, greatest] = retraction(mesh, ghost);
  EXPECT_NEAR(least, greatest, 2e-3 * kLength) << "rims are a little sharper than right-angled";
  const double retracted = kLength / std::sqrt(2.0) / std::cos(3.14159265358979 / 48);
  for (std::size_t v = 0; v < ghost.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    const double radius = std::hypot(p.x, p.y), wanted = radius > 4 ? 5 - retracted : 3 + retracted;
    EXPECT_NEAR(std::hypot(ghost[v].x, ghost[v].y), wanted, 2e-3 * kLength);
  }
}

TEST(GhostSurface, RetractsSharpTipsByTheWholeLength) {
  const double half = 0.1;  // of the cone's opening [rad]
  TriangleMesh cone{{{0, 0, 0}, {0, 0, 10}}, {}};
  for (std::uint32_t k = 0; k < 24; ++k) {
    const double q = 2 * 3.14159265358979 * k / 24, r = 10 * std::tan(half);
    cone.vertices.push_back({r * std::cos(q), r * std::sin(q), 10});
    const std::uint32_t next = 2 + (k + 1) % 24;
    cone.faces.push_back({{0, next, 2 + k}});
    cone.faces.push_back({{1, 2 + k, next}});
  }
  const std::vector<Vec3> ghost = ghost_vertices(cone.vertices, cone.faces, kLength);
  EXPECT_NEAR(ghost[0].z, kLength, 1e-6);
  EXPECT_NEAR(std::hypot(ghost[0].x, ghost[0].y), 0, 1e-6);
}

TEST(GhostSurface, RetractsBothFacesAtATJunction) {
  // A box whose front is divided along its upper edge, and whose top is not: the vertex there belongs to the front
  // only.
  TriangleMesh box = scenes::box({0, 0, 0}, {4, 4, 4});
  const auto middle = static_cast<std::uint32_t>(box.vertices.size());
  box.vertices.push_back({2, 0, 4});
  std::vector<Face> faces;
  for (const Face& f : box.faces) {
    int upper = -1;
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = box.vertices[f.v[i]], q = box.vertices[f.v[(i + 1) % 3]];
      const Vec3 third = box.vertices[f.v[(i + 2) % 3]];
      if (p.y == 0 && q.y == 0 && third.y == 0 && p.z == 4 && q.z == 4) upper = i;
    }
    if (upper < 0) {
      faces.push_back(f);
      continue;
    }
    const std::uint32_t p = f.v[upper], q = f.v[(upper + 1) % 3], third = f.v[(upper + 2) % 3];
    faces.push_back({{p, middle, third}});
    faces.push_back({{middle, q, third}});
  }
  ASSERT_EQ(faces.size(), box.faces.size() + 1);
  const std::vector<Vec3> ghost = ghost_vertices(box.vertices, faces, 0.1);
  EXPECT_GT(ghost[middle].y, 0.05);
  EXPECT_LT(ghost[middle].z, 3.95);
  EXPECT_NEAR(ghost[middle].x, 2, 1e-9);
}

TEST(GhostSurface, MovesVerticesAtOnePositionAlike) {
  TriangleMesh box = scenes::box({0, 0, 0}, {4, 5, 6});
  const std::vector<Vec3> welded = ghost_vertices(box.vertices, box.faces, kLength);
  TriangleMesh soup;
  for (std::uint32_t f = 0; f < box.faces.size(); ++f) {
    for (const std::uint32_t v : box.faces[f].v) soup.vertices.push_back(box.vertices[v]);
    soup.faces.push_back({{3 * f, 3 * f + 1, 3 * f + 2}});
  }
  const std::vector<Vec3> loose = ghost_vertices(soup.vertices, soup.faces, kLength);
  for (std::uint32_t f = 0; f < box.faces.size(); ++f)
    for (std::uint32_t k = 0; k < 3; ++k) EXPECT_LT(length(loose[3 * f + k] - welded[box.faces[f].v[k]]), 1e-15);
}

TEST(OpenEdges, AreTheEdgesOfOneFaceWhereVerticesAtOnePositionAreOne) {
  // A tube of faces with vertices of their own, some faces left out, some there twice, some without area.
  std::mt19937_64 random(5);
  const TriangleMesh tube = scenes::tube(5, 3, 0, 10, 24, 4);
  for (int round = 0; round < 20; ++round) {
    TriangleMesh soup;
    const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
      const auto at = static_cast<std::uint32_t>(soup.vertices.size());
      for (const Vec3& p : {a, b, c}) soup.vertices.push_back(p);
      soup.faces.push_back({{at, at + 1, at + 2}});
    };
    for (std::uint32_t f = 0; f < tube.faces.size(); ++f) {
      const Triangle t = tube.triangle(f);
      const auto dice = random() % 20;
      if (dice > 0) add(t[0], t[1], t[2]);
      if (dice == 1) add(t[1], t[2], t[0]);
      if (dice == 2) add(t[0], t[0], t[1]);
    }
    // By position: how often each edge occurs, and whether the result has it.
    using Position = std::tuple<double, double, double>;
    const auto position = [&](std::uint32_t v) {
      return Position(soup.vertices[v].x, soup.vertices[v].y, soup.vertices[v].z);
    };
    std::map<std::pair<Position, Position>, int> times;
    for (const Face& f : soup.faces)
      for (int k = 0; k < 3; ++k) {
        const Position a = position(f.v[k]), b = position(f.v[(k + 1) % 3]);
        if (a != b) ++times[std::minmax(a, b)];
      }
    std::set<std::pair<Position, Position>> expected, found;
    for (const auto& [edge, number] : times)
      if (number == 1) expected.insert(edge);
    const std::vector<std::uint32_t> first = first_at_position(soup.vertices);
    const RetractableSurface surface(soup.vertices, soup.faces);
    std::vector<bool> beside(soup.vertices.size());
    for (const HalfEdge& e : open_edges(soup.faces, first)) {
      const Position low = position(e.low), high = position(e.high);
      EXPECT_TRUE(found.insert(std::minmax(low, high)).second);
      EXPECT_EQ(first[e.low], e.low);
      EXPECT_EQ(first[e.high], e.high);
      EXPECT_LT(e.low, e.high);
      const Face& face = soup.faces[e.face];
      const std::uint32_t from = first[face.v[e.side]], to = first[face.v[(e.side + 1) % 3]];
      EXPECT_EQ(from, e.forward ? e.low : e.high);
      EXPECT_EQ(to, e.forward ? e.high : e.low);
      beside[e.low] = beside[e.high] = true;
    }
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(found, expected);
    EXPECT_EQ(surface.beside_open_edge(), beside);
    EXPECT_EQ(surface.first(), first);
  }
}

TEST(RetractableSurface, RetractsEachFaceByItsOwnDistanceAnyNumberOfTimes) {
  const TriangleMesh box = scenes::box({0, 0, 0}, {4, 5, 6});
  const RetractableSurface surface(box.vertices, box.faces);
  // The faces of two opposite sides are retracted by 0.3 and a half of that, the others by as much as they may.
  for (const double by : {0.3, 0.1, 0.3}) {
    std::vector<double> needed(box.faces.size());
    const auto side_of = [&](std::uint32_t f) { return normalized(normal_unscaled(box.triangle(f))).x; };
    for (std::uint32_t f = 0; f < needed.size(); ++f)
      needed[f] = side_of(f) > 0.5 ? by : side_of(f) < -0.5 ? by / 2 : 0;
    const std::vector<Vec3> ghost = surface.retracted({needed, 0, 0.05, 1});
    for (std::size_t v = 0; v < ghost.size(); ++v) {
      const Vec3 p = box.vertices[v], moved = ghost[v] - p;
      EXPECT_NEAR(moved.x, p.x > 2 ? -by : by / 2, 1e-9);
      EXPECT_NEAR(std::abs(moved.y), 0.05, 1e-9);
      EXPECT_NEAR(std::abs(moved.z), 0.05, 1e-9);
    }
    EXPECT_EQ(surface.retracted({{}, 0, kLength / std::sqrt(2.0), kLength}),
              ghost_vertices(box.vertices, box.faces, kLength));
  }
}

}  // namespace
}  // namespace dismantle
