// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/cuda_device.h"
#include "dismantle/streams/streams_backend.h"

#include <functional>
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
  using Make = std::function<std::unique_ptr<StreamsBackend>()>;

  /// @param on_device used until it fails
  /// @param make_other makes the other one, with all components in the assembled state
  FallbackStreamsBackend(std::unique_ptr<StreamsBackend> on_device, Make make_other,
                         std::shared_ptr<DeviceFailure> failure)
      : used_(std::move(on_device)), make_other_(std::move(make_other)), failure_(std::move(failure)) {
    state_.assign(used_->state().begin(), used_->state().end());
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
    used_->commit();
    state_ = next_;
  }
  void jump(Span<const RigidTransform> state) override {
    state_.assign(state.begin(), state.end());
    next_ = state_;
    try_on([&](StreamsBackend& backend) { backend.jump(state_); }, Repeat::No);
  }
  Span<const RigidTransform> state() const override { return used_->state(); }
  const AssemblyTriangles& fixed() const override { return used_->fixed(); }
  Span<const std::uint64_t> triangle_pairs() override {
    Span<const std::uint64_t> pairs;
    try_on([&](StreamsBackend& backend) { pairs = backend.triangle_pairs(); }, Repeat::AfterStep);
    return pairs;
  }
  const MovingStreams& on_host() override { return used_->on_host(); }

 private:
  /// Work to repeat on the other backend after it has received the state, ghosts and rules.
  enum class Repeat { No, Call, AfterStep };

  template <class Call>
  void try_on(const Call& call, Repeat repeat = Repeat::Call) {
    try {
      call(*used_);
      return;
    } catch (const CudaError& error) {
      if (!make_other_) throw;
      failure_->why = error.what();
    }
    failed_ = std::exchange(used_, std::exchange(make_other_, nullptr)());
    if (ghosts_ != nullptr) used_->set_ghosts(*ghosts_);
    if (rules_) used_->set_rules(*rules_);
    used_->jump(state_);
    if (repeat == Repeat::AfterStep) used_->step(next_);
    if (repeat != Repeat::No) call(*used_);
  }

  std::unique_ptr<StreamsBackend> used_, failed_;  // fixed() of the failed one may still be in use
  Make make_other_;                                // empty once it is in use
  std::shared_ptr<DeviceFailure> failure_;
  const GhostVertices* ghosts_ = nullptr;
  std::optional<PairRulesView> rules_;
  std::vector<RigidTransform> state_, next_;
};

}  // namespace dismantle
