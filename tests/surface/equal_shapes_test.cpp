// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/equal_shapes.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(EqualShapes, AreThoseOfInstancesAndOfMovedMeshes) {
  const TriangleMesh rod = scenes::tube(2, 0, 0, 30, 24), tube = scenes::tube(2, 1, 0, 30, 24);
  const Pose pose{{40, 5, -3}, normalized(Quat{0.3, -0.2, 0.7, 0.1})};
  Component first = scenes::component("rod", rod), instance = first, other = scenes::component("tube", tube);
  instance.assembly_from_mesh.translation = {9, 0, 0};
  const Component moved = scenes::component("rod moved", scenes::moved(rod, pose));
  const Component tube_moved = scenes::component("tube moved", scenes::moved(tube, pose));
  const std::vector<ComponentId> firsts = first_of_shape(scenes::assembly({first, other, instance, tube_moved, moved}));
  const auto ids = [](std::initializer_list<std::uint32_t> values) {
    return std::vector<ComponentId>(values.begin(), values.end());
  };
  EXPECT_EQ(firsts, ids({0, 1, 0, 1, 0}));
  EXPECT_EQ(shape_count(firsts), 2u);
}

TEST(EqualShapes, OfCadPartsMayBeTessellatedWithOtherVertices) {
  const TriangleMesh rod = scenes::tube(2, 0, 0, 30, 24, 1), divided = scenes::tube(2, 0, 0, 30, 24, 3);
  const Pose pose{{40, 5, -3}, normalized(Quat{0.3, -0.2, 0.7, 0.1})};
  Assembly assembly =
      scenes::assembly({scenes::component("rod", rod), scenes::component("longer", scenes::tube(2, 0, 0, 30.1, 24, 2)),
                        scenes::component("copy", scenes::moved(divided, pose))});
  EXPECT_EQ(first_of_shape(assembly)[2], ComponentId(2)) << "meshes of other vertices are other shapes";
  assembly.deflection = 0.01;
  EXPECT_EQ(first_of_shape(assembly)[2], ComponentId(0));
  EXPECT_EQ(first_of_shape(assembly)[1], ComponentId(1));
}

TEST(EqualShapes, AreFoundInTimeThatGrowsWithTheNumberOfComponents) {
  Assembly assembly = scenes::assembly({});
  for (int i = 0; i < 20000; ++i)
    assembly.components.push_back(
        scenes::component("box " + std::to_string(i), scenes::box({0, 0, 0}, {1, 2, 3 + 0.01 * (i % 10000)})));
  EXPECT_EQ(shape_count(first_of_shape(assembly)), 10000u);
}

}  // namespace
}  // namespace dismantle
