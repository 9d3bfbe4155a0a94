// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/bvh_build.h"

#include "dismantle/bvh/bvh_validate.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

struct Boxes {
  std::vector<Aabb> boxes;
  std::vector<std::uint32_t> component_begin{0};
  BvhInput input() const { return {boxes, component_begin}; }
};

Boxes boxes_of(const Assembly& assembly) {
  Boxes b;
  for (const Component& c : assembly.components) {
    const TriangleMesh mesh = assembled_mesh(c);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      Aabb box;
      for (int k = 0; k < 3; ++k) box.extend(mesh.triangle(f)[k]);
      b.boxes.push_back(box);
    }
    b.component_begin.push_back(static_cast<std::uint32_t>(b.boxes.size()));
  }
  return b;
}

TEST(BvhBuild, GivesAWellFormedTreeOverRandomAssemblies) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const Bvh bvh = bvh_build(boxes_of(scenes::random_assembly(random, 1 + static_cast<int>(seed), 8)).input(), {});
    EXPECT_EQ(bvh_validate(bvh), "");
  }
}

TEST(BvhBuild, AcceptsNoTrianglesOneTriangleAndEmptyComponents) {
  Boxes none;
  EXPECT_TRUE(bvh_build(none.input(), {}).empty());

  Boxes one;
  one.boxes.push_back({{0, 0, 0}, {1, 1, 1}});
  one.component_begin = {0, 1};
  EXPECT_EQ(bvh_validate(bvh_build(one.input(), {})), "");

  Boxes gaps = boxes_of(scenes::assembly({scenes::component("a", scenes::box({0, 0, 0}, {1, 1, 1}))}));
  gaps.component_begin = {0, 0, 7, 7, 8, 12, 12};  // components 0, 2 and 5 are empty, 3 is a single triangle
  const Bvh bvh = bvh_build(gaps.input(), {});
  EXPECT_EQ(bvh_validate(bvh), "");
  EXPECT_EQ(bvh.components[0].root, kNoNode);
  EXPECT_EQ(bvh.components[3].root, 7u);
  EXPECT_EQ(bvh.node_count() - bvh.top_begin, 2u);
}

TEST(BvhBuild, IsTheSameOnEveryExecutor) {
  Boxes b = boxes_of(scenes::assembly({scenes::component("tube", scenes::tube(10, 5, 0, 20, 120, 90)),
                                       scenes::component("box", scenes::box({30, 0, 0}, {31, 1, 1}))}));
  const Bvh expected = bvh_build(b.input(), {});
  EXPECT_EQ(bvh_validate(expected), "");
  for (const Executor& executor : all_executors()) EXPECT_EQ(bvh_build(b.input(), executor), expected);
}

TEST(BvhBuild, StaysShallowIfAllBoxesAreTheSame) {
  Boxes b;
  b.boxes.assign(5000, Aabb{{0, 0, 0}, {1, 1, 1}});
  b.component_begin = {0, 5000};
  const Bvh bvh = bvh_build(b.input(), {});
  EXPECT_EQ(bvh_validate(bvh), "");
  EXPECT_LE(bvh_depth(bvh), 13);
}

TEST(BvhBuild, BoundsItsDepthWhenTheHeuristicWouldNot) {
  Boxes b;  // sizes and positions grow geometrically: each split by area cuts off one box
  double at = 1;
  for (int i = 0; i < 600; ++i, at *= 1.3) b.boxes.push_back({{at, at, at}, {1.1 * at, 1.1 * at, 1.1 * at}});
  b.component_begin = {0, 600};
  const Bvh bvh = bvh_build(b.input(), {});
  EXPECT_EQ(bvh_validate(bvh), "");
  EXPECT_LE(bvh_depth(bvh), kBvhHeuristicDepth + 10);
}

}  // namespace
}  // namespace dismantle
