// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/vertex_tree.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace dismantle {
namespace {

/// All nodes below this one, parents first.
void list(const VertexNode& node, std::vector<VertexNode>& nodes) {
  nodes.push_back(node);
  if (node.leaf()) return;
  list(node.left(), nodes);
  list(node.right(), nodes);
}

std::vector<VertexNode> nodes_of(const VertexTree& tree) {
  std::vector<VertexNode> nodes;
  list(tree.root(), nodes);
  return nodes;
}

TEST(VertexTree, ContainsEveryVertexAtAnyScaleAndPosition) {
  std::mt19937_64 random(3);
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const double offset : {0.0, 1e3, 1e5}) {
      TriangleMesh mesh = scenes::moved(scenes::tube(5, 3, 0, 20, 40, 9), scenes::random_pose(random, offset, 3));
      for (Vec3& p : mesh.vertices) p = scale * p;
      const VertexTree tree = vertex_tree_build(mesh.vertices, {});
      for (const VertexNode& node : nodes_of(tree)) {
        const VertexSphere s = tree.sphere(node, mesh.vertices);
        for (std::uint32_t k = node.begin; k < node.end; ++k)
          ASSERT_LE(length(mesh.vertices[tree.order[k]] - s.center), s.radius) << scale << " " << offset;
      }
    }
}

TEST(VertexTree, HasEveryVertexOnceAndASphereOfItsOwnForEachInnerNode) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 20, 41, 9);
  const VertexTree tree = vertex_tree_build(mesh.vertices, {});
  EXPECT_EQ(std::set<std::uint32_t>(tree.order.begin(), tree.order.end()).size(), mesh.vertices.size());
  std::set<std::uint32_t> indices;
  std::size_t leaves = 0;
  for (const VertexNode& node : nodes_of(tree)) {
    if (node.leaf()) {
      ++leaves;
    } else {
      EXPECT_TRUE(indices.insert(node.index).second);
    }
  }
  EXPECT_EQ(leaves, mesh.vertices.size());
  EXPECT_EQ(indices.size(), tree.spheres.size());
  EXPECT_EQ(*indices.rbegin() + 1, tree.spheres.size());
}

TEST(VertexTree, MergesOnlyChildrenOfTheSameNode) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 20, 7, 3);
  const VertexTree tree = vertex_tree_build(mesh.vertices, {});
  const std::vector<VertexNode> nodes = nodes_of(tree);
  for (const VertexNode& node : nodes) {
    if (node.leaf()) continue;
    ASSERT_TRUE(node.left().left_of(node.right()));
    ASSERT_EQ(node.left().joined(node.right()), node);
  }
  const auto joinable = [&](const VertexNode& a) {
    return std::count_if(nodes.begin(), nodes.end(), [&](const VertexNode& b) { return a.left_of(b); });
  };
  for (const VertexNode& node : nodes) ASSERT_LE(joinable(node), 1);
  EXPECT_EQ(joinable(tree.root()), 0);
}

TEST(VertexTree, IsTheSameForEveryExecutor) {
  const TriangleMesh mesh = scenes::tube(5, 3, 0, 20, 100, 90);  // more vertices than one task has
  const VertexTree serial = vertex_tree_build(mesh.vertices, {});
  for (const Executor& executor : {Executor(ExecutorKind::Threads, 3), Executor(ExecutorKind::Shuffled)}) {
    const VertexTree other = vertex_tree_build(mesh.vertices, executor);
    EXPECT_EQ(other.order, serial.order);
    for (std::size_t i = 0; i < serial.spheres.size(); ++i) {
      ASSERT_EQ(other.spheres[i].center, serial.spheres[i].center);
      ASSERT_EQ(other.spheres[i].radius, serial.spheres[i].radius);
    }
  }
}

TEST(VertexTree, AcceptsOneVertexManyEqualOnesAndNone) {
  EXPECT_TRUE(vertex_tree_build({}, {}).empty());
  const std::vector<Vec3> one{{1, 2, 3}};
  const VertexTree single = vertex_tree_build(one, {});
  EXPECT_TRUE(single.root().leaf());
  EXPECT_EQ(single.sphere(single.root(), one).center, one[0]);
  const std::vector<Vec3> equal(100, Vec3{1, 2, 3});
  const VertexTree tree = vertex_tree_build(equal, {});
  EXPECT_LT(tree.sphere(tree.root(), equal).radius, 1e-6);
}

}  // namespace
}  // namespace dismantle
