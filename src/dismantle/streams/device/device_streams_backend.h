// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/streams/device/device_streams.h"

#include <utility>

namespace dismantle {

/// A backend with the streams on a device. Streams that are needed on the host are computed there on demand, from the
/// same matrices by the same kernels.
template <class Queue>
class DeviceStreamsBackend final : public StreamsBackend {
 public:
  /// All components in the assembled state.
  DeviceStreamsBackend(Queue queue, const Assembly& assembly, const CollisionOptions& options)
      : executor_(options.executor),
        host_(assembly, executor_),
        device_(std::move(queue), host_.fixed(), host_.bounds(), options),
        next_(state().begin(), state().end()) {}

  void set_ghosts(const GhostVertices& ghosts) override {
    host_.set_margins(ghosts.margins, executor_);
    device_.set_ghosts(ghosts, host_.bounds());
  }
  void set_rules(PairRulesView rules) override { device_.set_rules(rules); }
  StreamsStep step(Span<const RigidTransform> next) override {
    next_.assign(next.begin(), next.end());
    return device_.step(next);
  }
  void commit() override { device_.commit(); }
  void jump(Span<const RigidTransform> state) override {
    next_.assign(state.begin(), state.end());
    device_.jump(state);
  }
  Span<const RigidTransform> state() const override { return device_.state(); }

  const AssemblyTriangles& fixed() const override { return host_.fixed(); }
  Span<const std::uint64_t> triangle_pairs() override {
    triangle_pairs_ = device_.triangle_pairs();
    return triangle_pairs_;
  }
  const MovingStreams& on_host() override {
    host_.set_motion(state(), next_, executor_);
    host_.refit(executor_);
    return host_;
  }

 private:
  Executor executor_;
  MovingStreams host_;  // of some step, not necessarily the last
  DeviceStreams<Queue> device_;
  std::vector<RigidTransform> next_;
  std::vector<std::uint64_t> triangle_pairs_;
};

}  // namespace dismantle
