// SPDX-License-Identifier: Apache-2.0
// The kernel bodies of method streams on a CUDA device, compared bit by bit with the same bodies on the CPU. Skips
// without a device.
#include "tests/device/kernels_on_device.h"

#include "bench/baselines/device_appender.h"
#include "dismantle/exec/cuda_device.h"
#include "dismantle/streams/guarded_pairs.h"
#include "dismantle/streams/moving_streams.h"
#include "tests/support/engine_scene.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace dismantle {
namespace {

/// A step of a random assembly whose components overlap.
class KernelsOnDevice : public testing::Test {
 protected:
  void SetUp() override {
    const Result<std::string> name = cuda_device_name();
    if (!name) GTEST_SKIP() << "nothing runs on CUDA: " << name.error().message;
    RecordProperty("device", *name);
    std::mt19937_64 random(21);
    assembly_ = scenes::random_assembly(random, 12, 4);
    states_ = scenes::states_by_brute_force(assembly_, 0.01);
    streams_ = std::make_unique<MovingStreams>(assembly_, Executor());
    std::vector<RigidTransform> next(assembly_.components.size());
    for (RigidTransform& t : next)
      if (random() % 2 == 0) t = transform_from_pose(scenes::random_pose(random, 0.3, 0.1));
    streams_->set_next(next, Executor());
    streams_->refit(Executor());
  }

  BvhRefitInput refit_input() const {
    return {streams_->vertices_t0(), streams_->vertices_t1(), streams_->fixed().faces, 0};
  }
  FrontSproutKernel front_kernel() const {
    return {BvhView(streams_->fixed().bvh), streams_->bounds(), streams_->motion_class(), root_};
  }

  Assembly assembly_;
  PairStates states_;
  std::unique_ptr<MovingStreams> streams_;
  std::vector<std::uint64_t> root_;
};

template <class T>
bool same_bits(Span<const T> x, Span<const T> y) {
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(T)) == 0;
}

template <class T>
std::vector<T> sorted(Span<const T> values) {
  std::vector<T> copy(values.begin(), values.end());
  std::sort(copy.begin(), copy.end());
  return copy;
}

TEST_F(KernelsOnDevice, MoveVerticesToTheSameBits) {
  const RigidTransform transform = transform_from_pose({{1, -2, 3}, quat_about(normalized(Vec3{1, 2, 3}), 0.7)});
  std::vector<Vec3> expected;
  for (const Vec3& v : streams_->fixed().vertices) expected.push_back(transform * v);
  const std::vector<Vec3> moved = device::moved_vertices(streams_->fixed().vertices, transform);
  EXPECT_TRUE(same_bits<Vec3>(moved, expected));
}

TEST_F(KernelsOnDevice, FitBoundsToTheSameBits) {
  const AssemblyTriangles& fixed = streams_->fixed();
  const std::vector<Kdop16> expected = bvh_fit(fixed.bvh, fixed.refit_plan, refit_input(), Executor());
  EXPECT_TRUE(same_bits<Kdop16>(device::fitted_bounds(fixed.bvh, refit_input()), expected));
}

TEST_F(KernelsOnDevice, SproutTheSameFrontWithEveryAppendVariantFromCapacityOne) {
  const NodeIndex root = streams_->fixed().bvh.root();
  root_ = {pair_key(root, root)};
  FrontAppender expected(AppendVariant::GlobalLock, 1 << 16);
  expected.run(front_kernel(), Executor());
  EXPECT_GT(expected.values(FrontAppender::TrianglePairs).size(), 100u);
  for (const AppendVariant variant : kDeviceAppendVariants) {
    SCOPED_TRACE(name_of(variant));
    const auto appender = std::move(make_device_appender(variant, 1).value());
    appender->set_input(front_kernel());
    for (int run = 0; run < 2; ++run) {
      appender->run(root_);
      EXPECT_EQ(appender->replays() > 0, run == 0 && variant != AppendVariant::CountScanEmit);
      for (const auto stream : {FrontAppender::TrianglePairs, FrontAppender::Kept, FrontAppender::Rested,
                                FrontAppender::Sprouted, FrontAppender::Pending})
        EXPECT_EQ(sorted<std::uint64_t>(appender->values(stream)), sorted<std::uint64_t>(expected.values(stream)));
    }
  }
}

/// Keeps the results of the kernel on the CPU.
struct FindsOnHost {
  device::NarrowFinds finds;
  void contact(const TrianglePairContact& found) { finds.contacts.push_back(found); }
  void intersection(std::uint64_t key) { finds.intersections.push_back(key); }
  void tested(std::size_t count) { finds.tests += count; }
};

bool earlier(const TrianglePairContact& x, const TrianglePairContact& y) {
  return x.key < y.key;
}

TEST_F(KernelsOnDevice, TestTrianglePairsToTheSameBitsWithBothTestsFromCapacityOne) {
  const NodeIndex root = streams_->fixed().bvh.root();
  root_ = {pair_key(root, root)};
  FrontAppender front(AppendVariant::GlobalLock, 1 << 16);
  front.run(front_kernel(), Executor());
  const AssemblyTriangles& fixed = streams_->fixed();
  PairStates states = states_;
  states.pairs.resize(states.pairs.size() / 2);  // the other overlapping pairs are contacts
  const GuardedPairs guards(assembly_, states, fixed, {});
  for (const ElementaryTest test : {ElementaryTest::Certified, ElementaryTest::Elementary}) {
    const NarrowPhaseKernel kernel{
        front.values(FrontAppender::TrianglePairs),
        {streams_->vertices_t0(), streams_->vertices_t1(), fixed.faces},
        {guards.ghosts().displaced, guards.ghosts().margins, streams_->state(), streams_->next()},
        streams_->bounds(),
        fixed.bvh.component_of,
        fixed.features,
        guards.rules(),
        test};
    FindsOnHost expected;
    for (std::size_t i = 0; i < kernel.pairs.size(); ++i) kernel(i, expected);
    device::NarrowFinds finds = device::tested_pairs(kernel, 1);
    std::sort(expected.finds.contacts.begin(), expected.finds.contacts.end(), earlier);
    std::sort(finds.contacts.begin(), finds.contacts.end(), earlier);
    EXPECT_GT(finds.contacts.size(), 10u);
    EXPECT_EQ(finds.contacts, expected.finds.contacts);
    EXPECT_EQ(sorted<std::uint64_t>(finds.intersections), sorted<std::uint64_t>(expected.finds.intersections));
    EXPECT_EQ(finds.tests, expected.finds.tests);
  }
}

}  // namespace
}  // namespace dismantle
