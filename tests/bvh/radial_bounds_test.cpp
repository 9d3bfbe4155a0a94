// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/radial_bounds.h"

#include "dismantle/math/vec3f.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// The faces under each node.
void faces_under(const ObbTree& tree, std::uint32_t node, std::vector<std::uint32_t>& faces) {
  if (tree.nodes[node].leaf()) {
    faces.push_back(tree.nodes[node].child);
    return;
  }
  faces_under(tree, tree.nodes[node].child, faces);
  faces_under(tree, tree.nodes[node].child + 1, faces);
}

TEST(RevolutionSurface, BoundsEveryPointOfEveryNode) {
  std::mt19937_64 random(5);
  for (const double offset : {0.0, 1e3}) {
    const Pose pose = scenes::random_pose(random, offset, 3);
    const TriangleMesh mesh = scenes::moved(scenes::tube(10, 6, -20, 20, 20, 4), pose);
    const ObbTree tree = obb_tree_build(mesh.vertices, mesh.faces, Executor());
    const RevolutionSurface shape(mesh.vertices, mesh.faces, tree.nodes, revolution_axes(mesh.vertices, mesh.faces),
                                  {});
    ASSERT_EQ(shape.axes().size(), 1u);
    const RevolutionAxis axis = shape.axes()[0];
    const RadialBoundsList& nodes = shape.bounds_about(0);
    ASSERT_EQ(nodes.size(), tree.nodes.size());
    const double rounding = 1e-9 * (1 + offset);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      std::vector<std::uint32_t> faces;
      faces_under(tree, n, faces);
      const RadialBounds& node = nodes[n];
      if (faces.size() < RevolutionSurface::kLargeNode) {
        ASSERT_GT(node.max_radius, 1e9);
        continue;
      }
      for (const std::uint32_t f : faces) {
        const Triangle t = mesh.triangle(f);
        for (int i = 0; i < 12; ++i) {
          double u = std::abs(scenes::random_vector(random, 1).x), v = std::abs(scenes::random_vector(random, 1).y);
          if (u + v > 1) u = 1 - u, v = 1 - v;
          if (i < 3) u = i == 1, v = i == 2;
          const Vec3 p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) - axis.point;
          const double along = dot(p, axis.direction);
          const Vec3 across = p - along * axis.direction;
          ASSERT_GE(length(across), node.min_radius - rounding);
          ASSERT_LE(length(across), node.max_radius + rounding);
          ASSERT_GE(along, node.begin - rounding);
          ASSERT_LE(along, node.end + rounding);
          ASSERT_GE(dot(across, to_double(node.toward)), (node.cosine - 1e-5) * length(across) - rounding);
          const double facing = dot(normal_unscaled(t), across);
          const double rounded = 0.05 * length(normal_unscaled(t)) * length(across);  // of faces across the axis
          ASSERT_TRUE(!node.clear_out || facing > -rounded);
          ASSERT_TRUE(!node.clear_in || facing < rounded);
        }
      }
    }
  }
}

TEST(RevolutionSurface, KnowsWhetherFacesPointOutwards) {
  const TriangleMesh mesh = scenes::tube(10, 6, -20, 20, 20, 4);
  const ObbTree tree = obb_tree_build(mesh.vertices, mesh.faces, Executor());
  const RevolutionSurface shape(mesh.vertices, mesh.faces, tree.nodes, revolution_axes(mesh.vertices, mesh.faces), {});
  double outer_wall = 0, bore = 1e9;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const RadialBounds& node = shape.bounds_about(0)[n];
    if (node.clear_out && !node.clear_in) outer_wall = std::max<double>(outer_wall, node.min_radius);
    if (node.clear_in && !node.clear_out) bore = std::min<double>(bore, node.max_radius);
  }
  EXPECT_GT(outer_wall, 9.8);
  EXPECT_LT(outer_wall, 9.9) << "the middle of a facet";
  EXPECT_NEAR(bore, 6, 1e-5);
}

/// The spread of the root node.
float spread_of(const TriangleMesh& mesh) {
  const ObbTree tree = obb_tree_build(mesh.vertices, mesh.faces, Executor());
  const RevolutionSurface shape(mesh.vertices, mesh.faces, tree.nodes, revolution_axes(mesh.vertices, mesh.faces), {});
  return shape.bounds_about(0)[0].radial_deviation;
}

TEST(RevolutionSurface, RecognisesAWholeCylinderWithItsEnds) {
  for (const std::uint32_t sides : {8u, 24u, 200u}) {
    const double sagitta = 10 * (1 - std::cos(std::acos(-1.0) / sides));
    EXPECT_NEAR(spread_of(scenes::tube(10, 0, -20, 20, sides, 3)), sagitta, 1e-5) << sides;
  }
  EXPECT_GT(spread_of(scenes::tube(10, 9, -20, 20, 200)), 1e9) << "wall and bore";
}

TEST(RevolutionSurface, DistinguishesACylinderWithAGapFromAWholeOne) {
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 40; ++trial) {
    TriangleMesh mesh = scenes::moved(scenes::tube(10, 0, -20, 20, 48, 5), scenes::random_pose(random, 5, 3));
    ASSERT_LT(spread_of(mesh), 0.1);
    std::size_t face = random() % mesh.faces.size();
    while (std::abs(dot(normalized(normal_unscaled(mesh.triangle(static_cast<std::uint32_t>(face)))),
                        revolution_axes(mesh.vertices, mesh.faces)[0].direction)) > 0.5)
      face = (face + 1) % mesh.faces.size();
    mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(face));
    EXPECT_GT(spread_of(mesh), 1e9) << "face " << face;
  }
}

}  // namespace
}  // namespace dismantle
