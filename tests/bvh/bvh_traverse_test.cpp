// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/bvh_traverse.h"

#include "dismantle/surface/assembly_triangles.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

using LeafPairs = std::vector<std::pair<NodeIndex, NodeIndex>>;

struct Scene {
  AssemblyTriangles streams;
  std::vector<Kdop16> bounds;
};

Scene random_scene(unsigned seed, double margin) {
  std::mt19937_64 random(seed);
  Scene scene{make_assembly_triangles(scenes::random_assembly(random, 10, 3), {}), {}};
  scene.bounds = bounds_at(scene.streams, scene.streams.vertices, margin, {});
  return scene;
}

/// All pairs of leaves of different components (of `only`, if given) whose bounds overlap.
LeafPairs brute_force(const Scene& scene, std::pair<std::uint32_t, std::uint32_t> only, bool all) {
  LeafPairs pairs;
  const Bvh& bvh = scene.streams.bvh;
  for (NodeIndex a = 0; a < bvh.leaf_count(); ++a) {
    for (NodeIndex b = a + 1; b < bvh.leaf_count(); ++b) {
      const std::pair components(bvh.component_of[a], bvh.component_of[b]);
      if (components.first == components.second || (!all && components != only)) continue;
      if (overlaps(scene.bounds[a], scene.bounds[b])) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

LeafPairs traversed(const Scene& scene, NodePair start) {
  LeafPairs pairs;
  bvh_traverse(BvhView(scene.streams.bvh), scene.bounds, start,
               [&](NodeIndex a, NodeIndex b) { pairs.emplace_back(a, b); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(BvhTraverse, FindsTheSamePairsAsBruteForceFromTheRoot) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    for (const double margin : {0.0, 0.4}) {
      const Scene scene = random_scene(seed, margin);
      const NodeIndex root = scene.streams.bvh.root();
      const LeafPairs expected = brute_force(scene, {}, true);
      EXPECT_GT(expected.size(), 100u);
      EXPECT_EQ(traversed(scene, {root, root}), expected);
    }
  }
}

TEST(BvhTraverse, FindsTheSamePairsAsBruteForceBetweenTwoComponents) {
  const Scene scene = random_scene(11, 0.2);
  const std::vector<BvhComponent>& components = scene.streams.bvh.components;
  for (std::uint32_t a = 0; a < components.size(); ++a)
    for (std::uint32_t b = a + 1; b < components.size(); ++b)
      EXPECT_EQ(traversed(scene, {components[b].root, components[a].root}), brute_force(scene, {a, b}, false));
}

TEST(BvhTraverse, FindsTheComponentsWhoseBoundsOverlap) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = random_scene(seed, 0);
    const std::vector<BvhComponent>& components = scene.streams.bvh.components;
    std::vector<std::pair<ComponentId, ComponentId>> expected, found;
    for (std::uint32_t a = 0; a < components.size(); ++a)
      for (std::uint32_t b = a + 1; b < components.size(); ++b)
        if (overlaps(scene.bounds[components[a].root], scene.bounds[components[b].root]))
          expected.emplace_back(ComponentId(a), ComponentId(b));
    bvh_traverse_components(scene.streams.bvh, scene.bounds,
                            [&](ComponentId a, ComponentId b) { found.emplace_back(a, b); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(BvhTraverse, OfOneComponentOrNoneFindsNothing) {
  const AssemblyTriangles one =
      make_assembly_triangles(scenes::assembly({scenes::component("a", scenes::box({0, 0, 0}, {1, 1, 1}))}), {});
  const std::vector<Kdop16> bounds = bounds_at(one, one.vertices, 0, {});
  bvh_traverse(BvhView(one.bvh), bounds, {one.bvh.root(), one.bvh.root()}, [](NodeIndex, NodeIndex) { FAIL(); });
  bvh_traverse_components(one.bvh, bounds, [](ComponentId, ComponentId) { FAIL(); });
  bvh_traverse_components(Bvh{}, {}, [](ComponentId, ComponentId) { FAIL(); });
}

}  // namespace
}  // namespace dismantle
