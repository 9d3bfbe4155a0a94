// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/displaced_faces.h"

#include "tests/certificates/grabbed_component.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dismantle {
namespace {

using grabbed::kTolerance;

/// A component as one side of a pair.
struct Side {
  explicit Side(const Component& component) : tree(make_solid_tree(component, {})), shape(component) {}
  OverlapSide side() const {
    return {&tree, [this]() -> const SolidShape& { return shape; }};
  }
  SolidTree tree;
  SolidShape shape;
};

TEST(DisplacedFaces, CountWhatChangesAsIfAllWereCounted) {
  std::mt19937_64 random(3);
  std::size_t less = 0, not_less = 0;
  for (int i = 0; i < 40; ++i) {
    const Assembly assembly = scenes::random_assembly(random, 2, 0.7);
    const Side own(assembly.components[0]), other(assembly.components[1]);
    const OverlapSide mine = own.side(), others = other.side();
    const DisplacedFaces displaced(mine, others, kTolerance);
    DisplacedFaces::Meeting now = displaced.meeting(own.tree.vertices);
    EXPECT_EQ(now.of_face.size(), own.tree.faces.size());
    for (int change = 0; change < 8; ++change) {
      std::vector<Vec3> vertices = now.vertices;
      for (int k = 0; k < 3; ++k) vertices[random() % vertices.size()] += scenes::random_vector(random, 0.5);
      const DisplacedFaces::Meeting all = displaced.meeting(vertices);
      std::size_t total = 0;
      for (const std::uint32_t n : all.of_face) total += n;
      EXPECT_EQ(total, all.total);
      for (const std::size_t limit : {all.total, all.total + 1}) {
        const auto found = displaced.meeting_less(now, vertices, limit);
        ASSERT_EQ(found.has_value(), all.total < limit);
        ++(found ? less : not_less);
        if (!found) continue;
        EXPECT_EQ(found->total, all.total);
        EXPECT_EQ(found->of_face, all.of_face);
        EXPECT_EQ(found->vertices, vertices);
      }
      EXPECT_EQ(displaced.apart(vertices, false), all.total == 0);
      now = all;
    }
  }
  EXPECT_GE(less, 200u);
  EXPECT_GE(not_less, 200u);
}

TEST(DisplacedFaces, TestOnlyTheFacesThatChange) {
  std::mt19937_64 random(4);
  const Assembly assembly = scenes::random_assembly(random, 2, 0.5);
  const Side own(assembly.components[0]), other(assembly.components[1]);
  const OverlapSide mine = own.side(), others = other.side();
  const DisplacedFaces displaced(mine, others, kTolerance);
  const DisplacedFaces::Meeting before = displaced.meeting(own.tree.vertices);
  ASSERT_GT(before.total, 0u);
  const std::size_t tests = displaced.tests();
  EXPECT_TRUE(displaced.meeting_less(before, before.vertices, before.total + 1));
  EXPECT_EQ(displaced.tests(), tests);
}

}  // namespace
}  // namespace dismantle
