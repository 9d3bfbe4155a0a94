// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/front_parts.h"

#include "dismantle/bvh/bvh_traverse.h"
#include "dismantle/streams/bvtt_front_kernel.h"
#include "dismantle/surface/assembly_triangles.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

std::vector<std::uint64_t> sorted(Span<const std::uint64_t> keys) {
  std::vector<std::uint64_t> values(keys.begin(), keys.end());
  std::sort(values.begin(), values.end());
  return values;
}

std::vector<std::uint64_t> overlapping_leaves(const AssemblyTriangles& streams, Span<const Kdop16> bounds) {
  std::vector<std::uint64_t> keys;
  const Bvh& bvh = streams.bvh;
  for (NodeIndex a = 0; a < bvh.leaf_count(); ++a)
    for (NodeIndex b = a + 1; b < bvh.leaf_count(); ++b)
      if (bvh.component_of[a] != bvh.component_of[b] && overlaps(bounds[a], bounds[b])) keys.push_back(pair_key(a, b));
  return keys;
}

TEST(FrontParts, HoldsAllPairsOfLeavesThatOverlapAtEveryStepForAnyNumberOfParts) {
  std::mt19937_64 random(3);
  const Assembly assembly = scenes::random_assembly(random, 9, 4);
  const Executor serial;
  const AssemblyTriangles streams = make_assembly_triangles(assembly, serial);
  std::vector<std::pair<Executor, FrontParts>> fronts;
  for (const Executor& executor : all_executors()) fronts.emplace_back(executor, FrontParts(executor.thread_count()));
  std::vector<Vec3> vertices = streams.vertices;
  std::size_t pairs = 0;
  for (int step = 0; step < 40; ++step) {
    for (std::size_t c = 0; c < assembly.components.size(); ++c) {
      const RigidTransform shake = transform_from_pose(scenes::random_pose(random, 0.4, 0.1));
      for (std::uint32_t v = streams.vertex_begin[c]; v < streams.vertex_begin[c + 1]; ++v)
        vertices[v] = shake * vertices[v];
    }
    const std::vector<Kdop16> bounds = bounds_at(streams, vertices, 0, serial);
    const std::vector<std::uint64_t> expected = overlapping_leaves(streams, bounds);
    pairs += expected.size();
    for (auto& [executor, front] : fronts) {
      front.update({BvhView(streams.bvh), bounds, {}}, executor);
      ASSERT_EQ(sorted(front.triangle_pairs()), expected) << "step " << step;
      EXPECT_GE(front.size(), expected.size());
    }
  }
  EXPECT_GT(pairs, 1000u);
}

TEST(FrontParts, TakesAnAssemblyOfNothing) {
  const AssemblyTriangles streams = make_assembly_triangles(scenes::assembly({}), Executor());
  FrontParts front(2);
  front.update({BvhView(streams.bvh), {}, {}}, Executor());
  EXPECT_TRUE(front.triangle_pairs().empty());
}

}  // namespace
}  // namespace dismantle
