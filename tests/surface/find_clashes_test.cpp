// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/find_clashes.h"

#include "tests/support/faulty_meshes.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Clashes clashes_of(const Assembly& assembly, double clearance = 0, const Executor& executor = {}) {
  ClashOptions options;
  options.tolerance = 0.01;
  options.clearance = clearance;
  options.executor = executor;
  Result<Clashes> clashes = find_clashes(assembly, options);
  EXPECT_TRUE(clashes.ok());
  return clashes.ok() ? *clashes : Clashes{};
}

Assembly workshop() {
  return scenes::assembly({scenes::component("block", scenes::box({0, 0, 0}, {10, 10, 10})),
                           scenes::component("lid", scenes::box({0, 0, 10}, {10, 10, 12})),
                           scenes::component("peg", scenes::tube(1, 0, 0, 1, 4)),
                           scenes::component("core", scenes::box({2, 2, 2}, {4, 4, 4})),
                           scenes::component("far", scenes::box({0, 0, 12.3}, {1, 1, 13})),
                           scenes::component("almost", scenes::box({10.004, 0, 0}, {12, 1, 1}))});
}

TEST(FindClashes, ListsContactsOverlapsAndWhatIsNear) {
  const Clashes clashes = clashes_of(workshop(), 0.5);
  const auto pair = [&](std::uint32_t a, std::uint32_t b) {
    for (const Clash& c : clashes.pairs)
      if (c.a.value == a && c.b.value == b) return c;
    return Clash{};
  };
  EXPECT_EQ(clashes.pairs.size(), 5u);
  EXPECT_EQ(pair(0, 1).state, ClashState::Contact);
  EXPECT_EQ(pair(0, 1).distance, 0);
  EXPECT_LE(pair(0, 1).depth, 0.001);
  EXPECT_EQ(pair(0, 1).volume, 0);
  EXPECT_NEAR(pair(0, 1).deepest_at.z, 10, 1e-9);

  EXPECT_EQ(pair(0, 2).state, ClashState::Overlapping);
  EXPECT_FALSE(pair(0, 2).contained.valid());
  EXPECT_NEAR(pair(0, 2).volume, 0.5, 0.05);  // a quarter of a square of diagonal 2

  EXPECT_EQ(pair(0, 3).state, ClashState::Overlapping);
  EXPECT_EQ(pair(0, 3).contained, ComponentId(3));
  EXPECT_NEAR(pair(0, 3).depth, 4, 0.05);
  EXPECT_NEAR(pair(0, 3).volume, 8, 1e-9 + 3 * pair(0, 3).volume_error);

  EXPECT_EQ(pair(1, 4).state, ClashState::Near);
  EXPECT_NEAR(pair(1, 4).distance, 0.3, 1e-9);
  EXPECT_EQ(pair(1, 4).depth, 0);

  EXPECT_EQ(pair(0, 5).state, ClashState::Contact);
  EXPECT_NEAR(pair(0, 5).distance, 0.004, 1e-9);
  EXPECT_EQ(pair(0, 5).depth, 0);
}

TEST(FindClashes, IsTheSameOnEveryExecutor) {
  const Clashes serial = clashes_of(workshop(), 0.5);
  for (const ExecutorKind kind : {ExecutorKind::Threads, ExecutorKind::Shuffled})
    EXPECT_EQ(clashes_of(workshop(), 0.5, Executor(kind, 3)).pairs, serial.pairs);
}

TEST(FindClashes, EndsWhereProgressCancelsIt) {
  int calls = 0;
  ClashOptions options;
  options.progress = [&](std::string_view, double) { return ++calls < 4; };
  EXPECT_FALSE(find_clashes(workshop(), options).ok());
}

TEST(FindClashes, TakesComponentsWithoutFaces) {
  Assembly assembly = workshop();
  assembly.components[1].mesh = std::make_shared<const TriangleMesh>();
  EXPECT_EQ(clashes_of(assembly, 0.5).pairs.size(), 3u);
}

}  // namespace
}  // namespace dismantle
