// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/collision_engine.h"
#include "dismantle/collision/embedded_pairs.h"
#include "dismantle/collision/moving_streams.h"
#include "dismantle/collision/narrow_phase.h"
#include "dismantle/collision/stage_clock.h"
#include "dismantle/front/front.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Du et al. 2015, algorithm 1, one step at a time.
class StreamsEngine final : public CollisionEngine {
 public:
  StreamsEngine(const Assembly& assembly, const PairStates& pairs, const CollisionOptions& options)
      : options_(options),
        streams_(assembly, options.executor),
        front_(options.initial_capacity),
        narrow_phase_(options.initial_capacity),
        rules_(pairs),
        embedded_(assembly, pairs),
        next_(streams_.state().begin(), streams_.state().end()) {}

  SweepResult sweep(Span<const RigidTransform> next, double path_deviation) override;
  void commit() override;
  void jump(Span<const RigidTransform> state) override;
  Span<const RigidTransform> state() const override { return streams_.state(); }
  std::vector<ComponentPair> embedded_pairs() const override { return embedded_.pairs(); }

 private:
  NarrowPhaseInput narrow_phase_input(double path_deviation) const;
  EmbeddedStep embedded_step(double path_deviation) const;
  void test_embedded_pairs(const NarrowPhaseInput& input);
  void part(const std::vector<ComponentPair>& parted);

  CollisionOptions options_;
  MovingStreams streams_;
  Front front_;
  NarrowPhase narrow_phase_;
  PairRules rules_;
  EmbeddedPairs embedded_;  // S_i
  std::vector<RigidTransform> next_;
  std::vector<ComponentPair> parting_;  // those that leave S_i if the last sweep is committed
  bool may_commit_ = false;
};

NarrowPhaseInput StreamsEngine::narrow_phase_input(double path_deviation) const {
  return {front_.triangle_pairs(), &streams_, rules_.view(), options_.test, path_deviation};
}

SweepResult StreamsEngine::sweep(Span<const RigidTransform> next, double path_deviation) {
  DISMANTLE_EXPECT(2 * path_deviation <= rules_.tolerance());
  StageClock clock;
  SweepResult result;
  parting_.clear();
  next_.assign(next.begin(), next.end());

  streams_.set_next(next, options_.executor);
  result.timings.vertices = clock.lap();
  streams_.refit(options_.executor);
  result.timings.refit = clock.lap();
  const FrontUpdate update =
      front_.update({BvhView(streams_.fixed().bvh), streams_.bounds(), streams_.motion_class()}, options_.executor);
  result.timings.front = clock.lap();
  const NarrowPhaseInput input = narrow_phase_input(path_deviation);
  narrow_phase_.run(input, options_.executor);
  test_embedded_pairs(input);
  result.contacts = collision_contacts(streams_.fixed(), narrow_phase_.first_contacts());
  result.timings.intersection = clock.lap();

  for (const CollisionContact& contact : result.contacts) result.toi = std::min(result.toi, contact.toi);
  result.free = result.contacts.empty();
  result.sizes = {front_.size(), front_.triangle_pairs().size(), embedded_.pairs().size(), narrow_phase_.tests(),
                  update.replays + narrow_phase_.replays()};
  may_commit_ = result.free;
  result.timings.overall = clock.total();
  return result;
}

EmbeddedStep StreamsEngine::embedded_step(double path_deviation) const {
  return {&streams_.fixed(), step_triangles(streams_), streams_.bounds(), streams_.state(), next_, path_deviation};
}

void StreamsEngine::test_embedded_pairs(const NarrowPhaseInput& input) {
  for (const PartingPair& found :
       embedded_.parting(embedded_step(input.path_deviation), input.triangle_pairs, narrow_phase_.intersecting())) {
    parting_.push_back(found.pair);
    narrow_phase_.run_part(input, found.triangle_pairs, found.from, options_.executor);
  }
}

void StreamsEngine::commit() {
  DISMANTLE_EXPECT(may_commit_);
  streams_.commit();
  part(parting_);
  parting_.clear();
  may_commit_ = false;
}

void StreamsEngine::part(const std::vector<ComponentPair>& parted) {
  for (const ComponentPair& pair : parted) rules_.part(pair.a, pair.b);
  embedded_.part(parted);
}

void StreamsEngine::jump(Span<const RigidTransform> state) {
  streams_.jump(state, options_.executor);
  next_.assign(state.begin(), state.end());
  may_commit_ = false;
  parting_.clear();
  part(embedded_.apart(embedded_step(0)));
}

}  // namespace

std::unique_ptr<CollisionEngine> make_streams_engine(const Assembly& assembly, const PairStates& pairs,
                                                     const CollisionOptions& options) {
  return std::make_unique<StreamsEngine>(assembly, pairs, options);
}

}  // namespace dismantle
