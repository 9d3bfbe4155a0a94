// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/obb_tree.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <cstring>

namespace dismantle {
namespace {

ObbTree tree_of(const TriangleMesh& mesh, const Executor& executor = {}) {
  return obb_tree_build(mesh.vertices, mesh.faces, executor);
}

TEST(ObbTree, ContainsEveryTriangleWhereverTheMeshIs) {
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

}  // namespace
}  // namespace dismantle
