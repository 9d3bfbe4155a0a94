// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/fallback_streams_backend.h"

#include "tests/support/engine_scene.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// A device that fails in its n-th call.
class FailingBackend final : public StreamsBackend {
 public:
  FailingBackend(std::unique_ptr<StreamsBackend> backend, int calls_before)
      : backend_(std::move(backend)), left_(calls_before) {}
  void set_ghosts(const GhostVertices& ghosts) override { called().set_ghosts(ghosts); }
  void set_rules(PairRulesView rules) override { called().set_rules(rules); }
  StreamsStep step(Span<const RigidTransform> next) override { return called().step(next); }
  void commit() override { backend_->commit(); }
  void jump(Span<const RigidTransform> state) override { called().jump(state); }
  Span<const RigidTransform> state() const override { return backend_->state(); }
  const AssemblyTriangles& fixed() const override { return backend_->fixed(); }
  Span<const std::uint64_t> triangle_pairs() override { return called().triangle_pairs(); }
  const MovingStreams& on_host() override { return backend_->on_host(); }

 private:
  StreamsBackend& called() {
    if (left_-- == 0) throw CudaError("a kernel failed (the device is lost)");
    return *backend_;
  }

  std::unique_ptr<StreamsBackend> backend_;
  int left_;
};

TEST(FallbackStreamsBackend, GoesOnWithTheSameResultsWhereverTheDeviceFails) {
  bool finished = false;
  int failures = 0;
  for (int calls = 0; !finished; ++calls) {
    SCOPED_TRACE(calls);
    std::mt19937_64 random(21);
    const Assembly assembly = scenes::random_assembly(random, 8, 4);
    const PairStates states{0.01, {scenes::pair_of(0, 1, PairState::Free, 0)}};
    const CollisionOptions options{ElementaryTest::Certified, Executor(), 64};
    const auto failure = std::make_shared<DeviceFailure>();
    const auto make_host = [&] { return make_host_streams_backend(assembly, options); };
    auto device = std::make_unique<FailingBackend>(make_emulated_streams_backend(assembly, options, Executor()), calls);
    const auto expected = make_streams_engine(assembly, states, options);
    const auto engine = make_streams_engine(
        assembly, states, options, std::make_unique<FallbackStreamsBackend>(std::move(device), make_host, failure));
    std::vector<RigidTransform> next(8);
    for (int step = 0; step < 12; ++step) {
      for (RigidTransform& transform : next)
        if (random() % 2 == 0) transform = transform_from_pose(scenes::random_pose(random, 0.5, 0.2));
      const SweepResult a = expected->sweep(next, 1e-4), b = engine->sweep(next, 1e-4);
      ASSERT_EQ(a.blocking_pairs, b.blocking_pairs);
      ASSERT_EQ(a.toi, b.toi);
      if (step % 5 == 4) {
        expected->jump(next);
        engine->jump(next);
      } else if (a.free) {
        expected->commit();
        engine->commit();
      }
    }
    finished = failure->why.empty();
    failures += finished ? 0 : 1;
    if (!finished) {
      EXPECT_EQ(failure->why, "a kernel failed (the device is lost)");
    }
  }
  EXPECT_GT(failures, 10);
}

}  // namespace
}  // namespace dismantle
