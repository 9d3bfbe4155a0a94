// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/device/device_kernels.h"

#include "dismantle/exec/host_queue.h"
#include "dismantle/streams/device/device_buffers.h"
#include "dismantle/streams/moving_streams.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle::device_code {
namespace {

TEST(FitBounds, GivesTheBitsOfTheHostsRefitAndForgetsWhoArrived) {
  for (const Executor& executor : all_executors()) {
    std::mt19937_64 random(5);
    const Assembly assembly = scenes::random_assembly(random, 9, 4);
    MovingStreams host(assembly, executor);
    HostQueue queue(executor);
    Geometry geometry(queue, host.fixed());
    std::vector<Kdop16> bounds(host.bounds().begin(), host.bounds().end());
    std::vector<std::uint32_t> arrivals(geometry.children.size(), 0);
    for (int step = 0; step < 10; ++step) {
      std::vector<RigidTransform> next(9);
      std::vector<ComponentStep> components(9);
      for (std::size_t c = 0; c < next.size(); ++c) {
        next[c] = host.state()[c];
        if (random() % 3 != 0) continue;
        next[c] = transform_from_pose(scenes::random_pose(random, 1, 1));
        components[c].fit_bounds = 1;
      }
      host.jump(next, executor);
      const BvhRefitLeafKernel leaves{host.vertices_t0(), host.vertices_t1(), host.fixed().faces, bounds, 0};
      const std::vector<NodeIndex> parents = parents_of_nodes(host.fixed().bvh);
      const FitBounds fit{leaves, {geometry.tree(), bounds}, components, geometry.ranges.view(), parents, arrivals};
      executor.for_each(geometry.leaf_count, fit);
      EXPECT_TRUE(std::equal(bounds.begin(), bounds.end(), host.bounds().begin()));
      EXPECT_EQ(std::count(arrivals.begin(), arrivals.end(), 0u), static_cast<long>(arrivals.size()));
    }
  }
}

/// A front of five nodes of which three have sprouted.
struct SproutedFront {
  std::vector<std::uint64_t> front{10, 11, 12, 13, 14, 0, 0, 0};
  std::vector<std::uint64_t> sprouted{4, 0, 2};
  StepCounters counters;
  SproutedFront() {
    counters.front = 5;
    counters.sprouted = 3;
    counters.complete = 1;
  }
  std::vector<std::uint64_t> replaced_by(const std::vector<std::uint64_t>& kept) {
    counters.kept = kept.size();
    counters.next_front = counters.complete != 0 ? StepCapacity::front_needed(counters) : counters.front;
    Executor().for_each(8, ReplaceSprouted{&counters, kept, sprouted, front});
    std::vector<std::uint64_t> triangle_pairs(1);
    for (int repeat = 0; repeat < 2; ++repeat) BeginNarrowPhase{&counters, triangle_pairs}(0);
    return {front.begin(), front.begin() + static_cast<long>(counters.front)};
  }
};

TEST(ReplaceSprouted, PutsNewNodesIntoTheHolesAndBehindThem) {
  EXPECT_EQ(SproutedFront().replaced_by({20, 21, 22, 23}), (std::vector<std::uint64_t>{21, 11, 22, 13, 20, 23}));
}

TEST(ReplaceSprouted, LeavesDeadNodesIfFewerNodesSproutThanAreReplaced) {
  EXPECT_EQ(SproutedFront().replaced_by({20}), (std::vector<std::uint64_t>{kDeadNode, 11, kDeadNode, 13, 20}));
}

TEST(ReplaceSprouted, ChangesNothingIfTheFrontIsNotComplete) {
  SproutedFront sprouted;
  sprouted.counters.complete = 0;
  EXPECT_EQ(sprouted.replaced_by({20, 21, 22, 23}), (std::vector<std::uint64_t>{10, 11, 12, 13, 14}));
}

TEST(SproutFront, SkipsDeadNodes) {
  const std::vector<std::uint64_t> front{kDeadNode};
  StepCounters counters;
  counters.front = 1;
  SproutFront sprout{};
  sprout.kernel.items = front;
  sprout.counters = &counters;
  sprout(0);  // would read missing bounds
  EXPECT_EQ(counters.triangle_pairs, 0u);
}

TEST(StepCapacity, CountsTheNodesThatFindNoHole) {
  StepCounters counters;
  counters.front = 5;
  counters.sprouted = 3;
  counters.kept = 2;
  EXPECT_EQ(StepCapacity::front_needed(counters), 5u);
  counters.kept = 6;
  EXPECT_EQ(StepCapacity::front_needed(counters), 8u);
  counters.pending[2] = 4;
  EXPECT_TRUE((StepCapacity{8, 1, 6, 3, 4}.fits_front(counters)));
  EXPECT_FALSE((StepCapacity{8, 1, 6, 3, 3}.fits_front(counters)));
  EXPECT_FALSE((StepCapacity{7, 1, 6, 3, 4}.fits_front(counters)));
}

TEST(WordOfTime, KeepsTheOrderAndTheValueOfTimes) {
  const double times[] = {0, 5e-324, 1e-12, 0.25, 0.5, 1};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(time_of_word(word_of_time(times[i])), times[i]);
    if (i > 0) {
      EXPECT_LT(word_of_time(times[i - 1]), word_of_time(times[i]));
    }
  }
  EXPECT_EQ(word_of_time(-0.0), 0u);
}

}  // namespace
}  // namespace dismantle::device_code
