// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/obb_tree.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

namespace dismantle {
namespace {

ObbTree tree_of(const TriangleMesh& mesh, const Executor& executor = {}) {
  return obb_tree_build(mesh.vertices, mesh.faces, executor);
}

TEST(ObbTree, ContainsEveryTriangleAtAnyScaleAndPosition) {
  std::mt19937_64 random(20261121);
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const double offset : {0.0, 1e3, 1e5}) {
      TriangleMesh mesh = scenes::moved(scenes::tube(5, 3, 0, 20, 40, 9), scenes::random_pose(random, offset, 3));
      for (Vec3& p : mesh.vertices) p = scale * p;
      EXPECT_STREQ(obb_tree_fault(tree_of(mesh), mesh.vertices, mesh.faces), "") << scale << " " << offset;
    }
}

TEST(ObbTree, ContainsRandomTrianglesOfAllShapes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-6, 2);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 3000; i += 3) {
    const Vec3 at = scenes::random_vector(random, 50);
    for (int k = 0; k < 3; ++k)
      mesh.vertices.push_back(at + scenes::random_vector(random, std::pow(10, exponent(random))));
    mesh.faces.push_back({{i, i + 1, i + 2}});
  }
  EXPECT_STREQ(obb_tree_fault(tree_of(mesh), mesh.vertices, mesh.faces), "");
}

TEST(ObbTree, SeparatesDifferentPartsFirst) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 20, 40, 9);
  std::vector<std::uint8_t> parts(mesh.faces.size());
  for (std::size_t f = 0; f < parts.size(); ++f) parts[f] = static_cast<std::uint8_t>(f * 7 % 5);
  const ObbTree tree = obb_tree_build(mesh.vertices, mesh.faces, Executor(), parts);
  EXPECT_STREQ(obb_tree_fault(tree, mesh.vertices, mesh.faces), "");
  std::vector<std::set<std::uint8_t>> under(tree.nodes.size());
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n)
    if (tree.nodes[n].leaf())
      for (std::uint32_t up = n; up != ObbNode::kNone; up = tree.nodes[up].parent)
        under[up].insert(parts[tree.nodes[n].child]);
  const auto mixed = [](const std::set<std::uint8_t>& of) { return of.size() > 1; };
  EXPECT_EQ(std::count_if(under.begin(), under.end(), mixed), 4) << "one split fewer than there are parts";
}

TEST(ObbSubtree, ContainsTheNodesBelowItsRoot) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 20, 12, 3);
  const ObbTree tree = tree_of(mesh);
  const auto is_below = [&](std::uint32_t node, std::uint32_t top) {
    while (node != top && node != 0) node = tree.nodes[node].parent;
    return node == top;
  };
  std::vector<ObbSubtree> waiting{ObbSubtree::whole(tree)};
  std::size_t looked_at = 0;
  for (; looked_at < waiting.size(); ++looked_at) {
    const ObbSubtree subtree = waiting[looked_at];
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n)
      ASSERT_EQ(subtree.holds(n), is_below(n, subtree.node)) << n << " in " << subtree.node;
    if (!tree.nodes[subtree.node].leaf())
      for (const std::uint32_t k : {0u, 1u}) waiting.push_back(subtree.half(tree, k));
  }
  EXPECT_EQ(looked_at, tree.nodes.size());
}

TEST(ObbTree, CopesWithManyCopiesOfOneTriangle) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
  mesh.faces.assign(500, {{0, 1, 2}});
  EXPECT_STREQ(obb_tree_fault(tree_of(mesh), mesh.vertices, mesh.faces), "");
}

TEST(ObbTree, IsFlatOnAFlatFace) {
  const TriangleMesh mesh = scenes::moved(scenes::box({0, 0, 0}, {30, 20, 10}), {{3, 4, 5}, quat_about({1, 0, 0}, 1)});
  const ObbTree tree = tree_of(mesh);
  for (const ObbNode& node : tree.nodes)
    if (node.leaf()) {
      EXPECT_LT(node.box.half.z, 1e-5);
    }
}

TEST(ObbTree, CutsACylinderIntoStripsAlongItsAxis) {
  // Boxes at most 0.05 mm thick on a cylinder of radius 5: strips of 10 degrees suffice, at any length. Square boxes
  // would be some 4000.
  const TriangleMesh mesh = scenes::tube(5, 4, 0, 40, 128, 128);
  const ObbTree tree = tree_of(mesh);
  const auto thin = [&](std::uint32_t n) {
    const Vec3f half = tree.nodes[n].box.half;
    return 2 * std::min({half.x, half.y, half.z}) <= 0.05f;
  };
  std::size_t needed = 0;
  for (std::uint32_t n = 1; n < tree.nodes.size(); ++n) needed += thin(n) && !thin(tree.nodes[n].parent);
  EXPECT_LT(needed, 1000u);
}

TEST(ObbTree, KnowsTheCornersOfEveryFace) {
  const TriangleMesh mesh = scenes::moved(scenes::tube(5, 3, 0, 20, 12, 4), {{1e3, -2e3, 5e2}, {}});
  const ObbTree tree = tree_of(mesh);
  ASSERT_EQ(tree.triangles.size(), mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec3f corner = tree.triangles[f].corner[k];
      const Vec3 off = Vec3{corner.x, corner.y, corner.z} - (mesh.triangle(f)[k] - tree.origin);
      EXPECT_LE(max_abs(off), 0x1p-24 * 20);
    }
}

TEST(ObbTree, IsTheSameOnEveryExecutor) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 20, 120, 60);
  const ObbTree serial = tree_of(mesh);
  for (const Executor& executor : {Executor(ExecutorKind::Threads, 3), Executor(ExecutorKind::Shuffled)}) {
    const ObbTree other = tree_of(mesh, executor);
    ASSERT_EQ(serial.nodes.size(), other.nodes.size());
    EXPECT_EQ(std::memcmp(serial.nodes.data(), other.nodes.data(), serial.nodes.size() * sizeof(ObbNode)), 0);
  }
}

TEST(ObbTree, OfNothingIsEmpty) {
  EXPECT_TRUE(tree_of({}).empty());
}

TEST(ObbTreeRefit, ContainsDisplacedTrianglesWithTheSplitsOfTheKnownTree) {
  std::mt19937_64 random(20261127);
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 20, 60, 40);  // more than one task
  const ObbTree like = tree_of(mesh);
  for (const double far : {1e-9, 1e-3, 1.0, 100.0}) {
    TriangleMesh displaced = mesh;
    for (Vec3& p : displaced.vertices) p += scenes::random_vector(random, far);
    const ObbTree tree = obb_tree_refit(like, displaced.vertices, displaced.faces, {});
    EXPECT_STREQ(obb_tree_fault(tree, displaced.vertices, displaced.faces), "") << far;
    ASSERT_EQ(tree.nodes.size(), like.nodes.size());
    bool same_splits = true;
    for (std::size_t n = 0; n < tree.nodes.size(); ++n)
      same_splits = same_splits && tree.nodes[n].child == like.nodes[n].child &&
                    tree.nodes[n].parent == like.nodes[n].parent && tree.nodes[n].leaf() == like.nodes[n].leaf();
    EXPECT_TRUE(same_splits);
    const ObbTree threads =
        obb_tree_refit(like, displaced.vertices, displaced.faces, Executor(ExecutorKind::Threads, 3));
    EXPECT_EQ(std::memcmp(threads.nodes.data(), tree.nodes.data(), tree.nodes.size() * sizeof(ObbNode)), 0);
  }
}

TEST(ObbTreeRefit, OfTheSamePositionsIsTheSameTree) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 20, 40, 9);
  const ObbTree like = tree_of(mesh), tree = obb_tree_refit(like, mesh.vertices, mesh.faces, {});
  EXPECT_EQ(tree.origin, like.origin);
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    EXPECT_EQ(tree.nodes[n].box.center, like.nodes[n].box.center);
    EXPECT_EQ(tree.nodes[n].box.half, like.nodes[n].box.half);
    EXPECT_EQ(tree.nodes[n].size, like.nodes[n].size);
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(tree.triangles[f].corner[k], like.triangles[f].corner[k]);
  EXPECT_TRUE(obb_tree_refit({}, {}, {}, {}).empty());
}

}  // namespace
}  // namespace dismantle
