// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/guarded_engine.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace dismantle {

namespace {

class GuardedEngine final : public SweepEngine {
 public:
  GuardedEngine(std::unique_ptr<SweepEngine> engine, VertexDepthGuard guard)
      : engine_(std::move(engine)), guard_(std::move(guard)) {}

  SweepResult sweep(Span<const RigidTransform> next, double path_deviation) override {
    SweepResult result = engine_->sweep(next, path_deviation);
    if (!result.free) return result;
    const auto start = std::chrono::steady_clock::now();
    result.blocking_pairs = guard_.sweep(engine_->state(), next);
    for (const BlockingPair& c : result.blocking_pairs) result.toi = std::min(result.toi, c.toi);
    result.free = result.blocking_pairs.empty();
    const double spent = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    result.timings.intersection += spent;
    result.timings.overall += spent;
    return result;
  }
  void commit() override {
    engine_->commit();
    guard_.commit();
  }
  void jump(Span<const RigidTransform> state) override {
    engine_->jump(state);
    guard_.jump();
  }
  Span<const RigidTransform> state() const override { return engine_->state(); }
  std::vector<ComponentPair> overlapping_pairs() const override { return engine_->overlapping_pairs(); }

 private:
  std::unique_ptr<SweepEngine> engine_;
  VertexDepthGuard guard_;
};

}  // namespace

std::unique_ptr<SweepEngine> make_guarded_engine(std::unique_ptr<SweepEngine> engine, const Assembly& assembly,
                                                 const PairStates& pairs, const Executor& executor) {
  VertexDepthGuard guard(assembly, pairs, solids_of(assembly, executor), executor);
  if (guard.watches_nothing()) return engine;
  return std::make_unique<GuardedEngine>(std::move(engine), std::move(guard));
}

}  // namespace dismantle
