// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/bvtt_front.h"
#include "dismantle/streams/stage_clock.h"
#include "dismantle/streams/streams_backend.h"

namespace dismantle {

namespace {

/// A backend with all streams in host memory.
class HostStreamsBackend final : public StreamsBackend {
 public:
  HostStreamsBackend(const Assembly& assembly, const CollisionOptions& options)
      : executor_(options.executor),
        test_(options.test),
        streams_(assembly, options.executor),
        front_(options.initial_capacity, options.append_lock),
        narrow_phase_(options.initial_capacity, options.append_lock) {}

  void set_ghosts(const GhostVertices& ghosts) override {
    ghosts_ = &ghosts;
    streams_.set_margins(ghosts.margins, executor_);
  }
  void set_rules(PairRulesView rules) override { rules_ = rules; }
  StreamsStep step(Span<const RigidTransform> next) override;
  void commit() override { streams_.commit(); }
  void jump(Span<const RigidTransform> state) override { streams_.jump(state, executor_); }
  Span<const RigidTransform> state() const override { return streams_.state(); }
  const AssemblyTriangles& fixed() const override { return streams_.fixed(); }
  Span<const std::uint64_t> triangle_pairs() override { return front_.triangle_pairs(); }
  const MovingStreams& on_host() override { return streams_; }

 private:
  Executor executor_;
  ElementaryTest test_;
  MovingStreams streams_;
  Front front_;
  NarrowPhase narrow_phase_;
  PairRulesView rules_;
  const GhostVertices* ghosts_ = nullptr;
};

StreamsStep HostStreamsBackend::step(Span<const RigidTransform> next) {
  StageClock clock;
  StreamsStep step;
  streams_.set_next(next, executor_);
  step.timings.vertices = clock.lap();
  streams_.refit(executor_);
  step.timings.refit = clock.lap();
  const FrontUpdate update =
      front_.update({BvhView(streams_.fixed().bvh), streams_.bounds(), streams_.motion_class()}, executor_);
  step.timings.front = clock.lap();
  narrow_phase_.run({front_.triangle_pairs(), &streams_, rules_, test_, ghosts_}, executor_);
  step.contacts = narrow_phase_.first_contacts();
  step.intersecting.assign(narrow_phase_.intersecting().begin(), narrow_phase_.intersecting().end());
  step.timings.intersection = clock.lap();
  step.sizes.front = front_.size();
  step.sizes.triangle_pairs = front_.triangle_pairs().size();
  step.sizes.elementary_tests = narrow_phase_.tests();
  step.sizes.replays = update.replays + narrow_phase_.replays();
  return step;
}

}  // namespace

std::unique_ptr<StreamsBackend> make_host_streams_backend(const Assembly& assembly, const CollisionOptions& options) {
  return std::make_unique<HostStreamsBackend>(assembly, options);
}

}  // namespace dismantle
