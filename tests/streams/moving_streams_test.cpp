// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/moving_streams.h"

#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

/// The expected streams, recomputed.
void expect_fresh(const MovingStreams& streams, const std::vector<RigidTransform>& start,
                  const std::vector<RigidTransform>& end) {
  const AssemblyTriangles& fixed = streams.fixed();
  std::vector<Vec3> vertices_t0 = fixed.vertices, vertices_t1 = fixed.vertices;
  for (std::uint32_t c = 0; c < fixed.component_count(); ++c) {
    for (std::uint32_t v = fixed.vertex_begin[c]; v < fixed.vertex_begin[c + 1]; ++v) {
      vertices_t0[v] = start[c] * fixed.vertices[v];
      vertices_t1[v] = end[c] * fixed.vertices[v];
    }
  }
  ASSERT_TRUE(std::equal(vertices_t0.begin(), vertices_t0.end(), streams.vertices_t0().begin()));
  ASSERT_TRUE(std::equal(vertices_t1.begin(), vertices_t1.end(), streams.vertices_t1().begin()));
  const std::vector<Kdop16> bounds =
      bvh_fit(fixed.bvh, fixed.refit_plan, {vertices_t0, vertices_t1, fixed.faces, 0}, {});
  ASSERT_TRUE(std::equal(bounds.begin(), bounds.end(), streams.bounds().begin()));
}

TEST(MovingStreams, EqualARecomputationAfterAnySteps) {
  for (const Executor& executor : all_executors()) {
    std::mt19937_64 random(8);
    const Assembly assembly = scenes::random_assembly(random, 6, 4);
    MovingStreams streams(assembly, executor);
    std::vector<RigidTransform> state(6);
    expect_fresh(streams, state, state);
    for (int step = 0; step < 40; ++step) {
      std::vector<RigidTransform> next = state;
      for (RigidTransform& t : next)
        if (random() % 3 == 0) t = transform_from_pose(scenes::random_pose(random, 1, 1)) * t;
      if (random() % 6 == 0) {
        streams.jump(next, executor);
        state = next;
        expect_fresh(streams, state, state);
        continue;
      }
      streams.set_next(next, executor);
      streams.refit(executor);
      expect_fresh(streams, state, next);
      if (random() % 3 == 0) continue;  // not committed: the state stays
      streams.commit();
      state = next;
      ASSERT_TRUE(std::equal(state.begin(), state.end(), streams.state().begin()));
    }
  }
}

}  // namespace
}  // namespace dismantle
