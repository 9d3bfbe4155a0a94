// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/bvtt_front.h"

#include "dismantle/surface/assembly_triangles.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace dismantle {
namespace {

using Keys = std::vector<std::uint64_t>;

/// A moving assembly, with its bounds over the current step.
struct MovingScene {
  AssemblyTriangles streams;
  std::vector<Vec3> start, end;
  std::vector<Kdop16> bounds;
  std::vector<std::uint32_t> motion_class;

  explicit MovingScene(const Assembly& assembly) : streams(make_assembly_triangles(assembly, {})) {
    start = end = streams.vertices;
    motion_class.assign(streams.component_count(), 0);
  }

  /// Moves each component of a class other than 0 by its class's transform; the others do not move.
  void step(const std::vector<std::uint32_t>& classes, const std::vector<RigidTransform>& transforms) {
    motion_class = classes;
    start = end;
    for (std::uint32_t c = 0; c < classes.size(); ++c)
      for (std::uint32_t v = streams.vertex_begin[c]; classes[c] > 0 && v < streams.vertex_begin[c + 1]; ++v)
        end[v] = transforms[classes[c]] * end[v];
    bounds = bvh_fit(streams.bvh, streams.refit_plan, {start, end, streams.faces, 0}, {});
  }

  FrontInput input() const { return {BvhView(streams.bvh), bounds, motion_class}; }

  Keys brute_force() const {
    Keys keys;
    const std::vector<std::uint32_t>& component = streams.bvh.component_of;
    for (NodeIndex a = 0; a < streams.bvh.leaf_count(); ++a)
      for (NodeIndex b = a + 1; b < streams.bvh.leaf_count(); ++b)
        if (component[a] != component[b] && motion_class[component[a]] != motion_class[component[b]] &&
            overlaps(bounds[a], bounds[b]))
          keys.push_back(pair_key(a, b));
    return keys;
  }
};

Keys keys_of(Span<const std::uint64_t> keys) {
  return Keys(keys.begin(), keys.end());
}

Keys sorted(Keys keys) {
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// Fronts on every executor, with different initial capacities.
struct FrontUnderTest {
  Executor executor;
  std::unique_ptr<Front> front;
};

std::vector<FrontUnderTest> all_fronts() {
  std::vector<FrontUnderTest> fronts;
  for (const Executor& executor : all_executors())
    for (const std::size_t capacity : {1u, 300u, 1u << 16})
      fronts.push_back({executor, std::make_unique<Front>(capacity)});
  return fronts;
}

std::vector<std::uint32_t> random_classes(std::mt19937_64& random, std::size_t count) {
  std::vector<std::uint32_t> classes(count, 0);
  for (std::uint32_t& c : classes) c = random() % 3 == 0 ? 1 + random() % 2 : 0;
  return classes;
}

TEST(Front, FindsTheTrianglePairsOfBruteForceAtEveryStepFromCapacityOneOnEveryExecutor) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    MovingScene scene(scenes::random_assembly(random, 14, 4));
    std::vector<FrontUnderTest> fronts = all_fronts();
    std::vector<std::uint32_t> classes = random_classes(random, scene.streams.component_count());
    std::size_t found = 0;
    for (int step = 0; step < 30; ++step) {
      if (step % 7 == 6) classes = random_classes(random, scene.streams.component_count());
      std::vector<RigidTransform> transforms(3);
      for (RigidTransform& t : transforms) t = transform_from_pose(scenes::random_pose(random, 0.3, 0.1));
      scene.step(classes, transforms);
      const Keys expected = scene.brute_force();
      found += expected.size();
      Keys first_active;
      for (FrontUnderTest& f : fronts) {
        f.front->update(scene.input(), f.executor);
        ASSERT_EQ(keys_of(f.front->triangle_pairs()), expected) << "step " << step;
        const Keys active = sorted(keys_of(f.front->active()));
        if (first_active.empty()) first_active = active;
        ASSERT_EQ(active, first_active) << "step " << step;
        ASSERT_EQ(f.front->size(), fronts.front().front->size()) << "step " << step;
      }
    }
    EXPECT_GT(found, 1000u);
  }
}

TEST(Front, IsACutThatContainsEveryLeafPairOnce) {
  std::mt19937_64 random(5);
  MovingScene scene(scenes::random_assembly(random, 6, 3));
  Front front(1);
  for (int step = 0; step < 10; ++step) {
    scene.step(random_classes(random, 6), std::vector<RigidTransform>(3, transform_from_pose({{0.2, 0, 0}, {}})));
    front.update(scene.input(), Executor());

    // Counts, for every two leaves, the nodes of the front above them.
    const Bvh& bvh = scene.streams.bvh;
    const NodeIndex n = bvh.leaf_count();
    std::vector<std::vector<NodeIndex>> below(bvh.node_count());
    for (NodeIndex leaf = 0; leaf < n; ++leaf) below[leaf] = {leaf};
    for (NodeIndex i = n; i < bvh.node_count(); ++i) {
      for (const NodeIndex child : {bvh.children[i - n].left, bvh.children[i - n].right})
        below[i].insert(below[i].end(), below[child].begin(), below[child].end());
    }
    std::vector<int> covered(std::size_t{n} * n, 0);
    for (const Span<const std::uint64_t> part : {front.active(), front.resting()})
      for (const std::uint64_t key : part)
        for (const NodeIndex a : below[pair_of_key(key).a])
          for (const NodeIndex b : below[pair_of_key(key).b])
            ++covered[std::size_t{std::min(a, b)} * n + std::max(a, b)];
    for (NodeIndex a = 0; a < n; ++a)
      for (NodeIndex b = a + 1; b < n; ++b)
        ASSERT_EQ(covered[std::size_t{a} * n + b], bvh.component_of[a] == bvh.component_of[b] ? 0 : 1);
  }
}

TEST(Front, LeavesAloneWhatDoesNotMove) {
  MovingScene scene(scenes::assembly({scenes::component("a", scenes::tube(5, 3, 0, 10, 40, 20)),
                                      scenes::component("b", scenes::tube(3, 1, 0, 10, 40, 20)),
                                      scenes::component("far", scenes::box({50, 0, 0}, {51, 1, 1}))}));
  Front front(1);
  const std::vector<RigidTransform> shift(3, transform_from_pose({{0.1, 0, 0}, {}}));
  scene.step({0, 0, 1}, shift);  // a and b touch everywhere, but neither moves
  front.update(scene.input(), Executor());
  EXPECT_TRUE(front.triangle_pairs().empty());
  EXPECT_EQ(front.resting().size(), 1u);
  EXPECT_LT(front.size(), 10u);
  scene.step({1, 1, 0}, shift);  // a and b move together
  front.update(scene.input(), Executor());
  EXPECT_TRUE(front.triangle_pairs().empty());
  scene.step({0, 1, 0}, shift);
  front.update(scene.input(), Executor());
  EXPECT_EQ(keys_of(front.triangle_pairs()), scene.brute_force());
  EXPECT_GT(front.triangle_pairs().size(), 1000u);
}

TEST(Front, RestartsWhenItsGrowthCostsMore) {
  MovingScene scene(scenes::assembly({scenes::component("plate", scenes::tube(40, 0, 0, 1, 200, 10)),
                                      scenes::component("pin", scenes::tube(1, 0, 1.2, 4, 40, 20))}));
  Front front(1 << 10);
  std::size_t largest = 0;
  const std::vector<RigidTransform> shift(2, transform_from_pose({{0, 0, -0.005}, {}}));
  bool shrunk = false;
  for (int step = 0; step < 400 && !shrunk; ++step) {
    scene.step({0, 1}, shift);
    front.update(scene.input(), Executor());
    shrunk = front.size() < largest;
    largest = std::max(largest, front.size());
    if (step % 40 == 0 || shrunk) {
      ASSERT_EQ(keys_of(front.triangle_pairs()), scene.brute_force());
    }
  }
  EXPECT_TRUE(shrunk);
}

TEST(Front, OfOneComponentOrNoneIsEmpty) {
  for (const Assembly& assembly :
       {scenes::assembly({}), scenes::assembly({scenes::component("a", scenes::box({0, 0, 0}, {1, 1, 1}))})}) {
    MovingScene scene(assembly);
    scene.step(std::vector<std::uint32_t>(scene.streams.component_count(), 1), std::vector<RigidTransform>(2));
    Front front(1);
    front.update(scene.input(), Executor());
    EXPECT_EQ(front.size(), 0u);
    EXPECT_TRUE(front.triangle_pairs().empty());
  }
}

}  // namespace
}  // namespace dismantle
