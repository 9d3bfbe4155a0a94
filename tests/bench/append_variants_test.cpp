// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/append_variants.h"

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

// Two tubes in each other, a front that starts from the root: more than one item's budget, so rounds and replays.
TEST(AppendVariants, PutTheSameIntoEveryStreamOnEveryExecutorFromCapacityOne) {
  const Assembly assembly = scenes::assembly({scenes::component("tube", scenes::tube(10, 5, 0, 20, 48, 8)),
                                              scenes::component("peg", scenes::tube(5, 0, 0, 20, 48, 8)),
                                              scenes::component("still", scenes::tube(12, 9, 0, 20, 24, 2))});
  const AssemblyTriangles streams = make_assembly_triangles(assembly, Executor());
  const std::vector<Kdop16> bounds = bounds_at(streams, streams.vertices, 0.01, Executor());
  const std::vector<std::uint32_t> motion_class{0, 1, 0};
  const NodeIndex root = streams.bvh.root();
  const std::vector<std::uint64_t> items{pair_key(root, root)};
  const FrontSproutKernel kernel{BvhView(streams.bvh), bounds, motion_class, items};

  FrontAppender reference(AppendVariant::GlobalLock, 1 << 20);
  reference.run(kernel, Executor());
  EXPECT_GT(reference.values(FrontAppender::TrianglePairs).size(), 1000u);
  EXPECT_GT(reference.values(FrontAppender::Kept).size(), 1000u);
  EXPECT_EQ(reference.values(FrontAppender::Rested).size(), 1u);
  EXPECT_EQ(reference.values(FrontAppender::Sprouted).size(), 1u);
  for (const AppendVariant variant : kAppendVariants) {
    for (const Executor& executor : all_executors()) {
      FrontAppender appender(variant, 1);
      for (int run = 0; run < 2; ++run) {
        appender.run(kernel, executor);
        for (const auto stream : {FrontAppender::TrianglePairs, FrontAppender::Kept, FrontAppender::Rested,
                                  FrontAppender::Sprouted, FrontAppender::Pending})
          ASSERT_EQ(sorted(appender.values(stream)), sorted(reference.values(stream))) << name_of(variant);
      }
    }
  }
}

}  // namespace
}  // namespace dismantle
