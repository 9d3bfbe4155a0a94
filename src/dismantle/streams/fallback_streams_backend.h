// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/device_fallback.h"
#include "dismantle/streams/streams_backend.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// A backend that goes on with another one when its device fails (CudaError): nothing is lost, since every backend
/// gives the same results. Not tried again.
class FallbackStreamsBackend final : public StreamsBackend {
 public:
  /// Makes a backend.
  using Make = DeviceFallback<StreamsBackend>::Make;

  /// @param on_device used until it fails
  /// @param make_other makes the other one, with all components in the assembled state
  FallbackStreamsBackend(std::unique_ptr<StreamsBackend> on_device, Make make_other,
                         std::shared_ptr<DeviceFailure> failure)
      : fallback_(std::move(on_device), std::move(make_other), std::move(failure)) {
    state_.assign(fallback_.used().state().begin(), fallback_.used().state().end());
    next_ = state_;
  }

  void set_ghosts(const GhostVertices& ghosts) override {
    ghosts_ = &ghosts;
    try_on([&](StreamsBackend& backend) { backend.set_ghosts(ghosts); }, Repeat::No);
  }
  void set_rules(PairRulesView rules) override {
    rules_ = rules;
    try_on([&](StreamsBackend& backend) { backend.set_rules(rules); }, Repeat::No);
  }
  StreamsStep step(Span<const RigidTransform> next) override {
    next_.assign(next.begin(), next.end());
    StreamsStep made;
    try_on([&](StreamsBackend& backend) { made = backend.step(next_); });
    return made;
  }
  void commit() override {
    fallback_.used().commit();
    state_ = next_;
  }
  void jump(Span<const RigidTransform> state) override {
    state_.assign(state.begin(), state.end());
    next_ = state_;
    try_on([&](StreamsBackend& backend) { backend.jump(state_); }, Repeat::No);
  }
  Span<const RigidTransform> state() const override { return fallback_.used().state(); }
  const AssemblyTriangles& fixed() const override { return fallback_.used().fixed(); }
  Span<const std::uint64_t> triangle_pairs() override {
    Span<const std::uint64_t> pairs;
    try_on([&](StreamsBackend& backend) { pairs = backend.triangle_pairs(); }, Repeat::AfterStep);
    return pairs;
  }
  const MovingStreams& on_host() override { return fallback_.used().on_host(); }

 private:
  /// Work to repeat on the other backend after it has received the state, ghosts and rules.
  enum class Repeat { No, Call, AfterStep };

  template <class Call>
  void try_on(const Call& call, Repeat repeat = Repeat::Call) {
    fallback_.try_on(call, [&](StreamsBackend& other) {
      if (ghosts_ != nullptr) other.set_ghosts(*ghosts_);
      if (rules_) other.set_rules(*rules_);
      other.jump(state_);
      if (repeat == Repeat::AfterStep) other.step(next_);
      if (repeat != Repeat::No) call(other);
    });
  }

  DeviceFallback<StreamsBackend> fallback_;
  Make make_other_;  // empty once it is in use
  std::shared_ptr<DeviceFailure> failure_;
  const GhostVertices* ghosts_ = nullptr;
  std::optional<PairRulesView> rules_;
  std::vector<RigidTransform> state_, next_;
};

}  // namespace dismantle
