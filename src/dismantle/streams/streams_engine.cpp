// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/embedded_pairs.h"
#include "dismantle/streams/stage_clock.h"
#include "dismantle/streams/streams_backend.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Du et al. 2015, algorithm 1, one step at a time: handles the pairs of S_i; a backend does the rest.
class StreamsEngine final : public SweepEngine {
 public:
  StreamsEngine(const Assembly& assembly, const PairStates& pairs, const CollisionOptions& options,
                std::unique_ptr<StreamsBackend> backend)
      : options_(options),
        backend_(std::move(backend)),
        rules_(pairs),
        embedded_(assembly, pairs),
        next_(state().begin(), state().end()) {
    backend_->set_rules(rules_.view());
  }

  SweepResult sweep(Span<const RigidTransform> next, double path_deviation) override;
  void commit() override;
  void jump(Span<const RigidTransform> state) override;
  Span<const RigidTransform> state() const override { return backend_->state(); }
  std::vector<ComponentPair> overlapping_pairs() const override { return embedded_.pairs(); }

 private:
  EmbeddedStep embedded_step(const MovingStreams& streams, double path_deviation) const;
  void test_embedded_pairs(StreamsStep& step, double path_deviation);
  void part(const std::vector<ComponentPair>& parted);

  CollisionOptions options_;
  std::unique_ptr<StreamsBackend> backend_;
  PairRules rules_;
  EmbeddedPairs embedded_;  // S_i
  std::vector<RigidTransform> next_;
  std::vector<ComponentPair> parting_;  // pairs that leave S_i if the last sweep is committed
  bool may_commit_ = false;
};

SweepResult StreamsEngine::sweep(Span<const RigidTransform> next, double path_deviation) {
  DISMANTLE_EXPECT(2 * path_deviation <= rules_.tolerance());
  StageClock clock;
  parting_.clear();
  next_.assign(next.begin(), next.end());

  StreamsStep step = backend_->step(next, path_deviation);
  StageClock embedded_clock;
  test_embedded_pairs(step, path_deviation);
  SweepResult result;
  result.blocking_pairs = blocking_pairs(backend_->fixed(), first_of(step.contacts));
  step.timings.intersection += embedded_clock.total();

  for (const BlockingPair& contact : result.blocking_pairs) result.toi = std::min(result.toi, contact.toi);
  result.free = result.blocking_pairs.empty();
  result.timings = step.timings;
  result.sizes = step.sizes;
  result.sizes.intersection_pairs = embedded_.pairs().size();
  may_commit_ = result.free;
  result.timings.overall = clock.total();
  return result;
}

EmbeddedStep StreamsEngine::embedded_step(const MovingStreams& streams, double path_deviation) const {
  return {&streams.fixed(), step_triangles(streams), streams.bounds(), state(), next_, path_deviation};
}

void StreamsEngine::test_embedded_pairs(StreamsStep& step, double path_deviation) {
  if (!embedded_.any_moves(state(), next_)) return;
  const MovingStreams& streams = backend_->on_host();
  const NarrowPhaseInput input{backend_->triangle_pairs(), &streams, rules_.view(), options_.test, path_deviation};
  for (const PartingPair& found :
       embedded_.parting(embedded_step(streams, path_deviation), input.triangle_pairs, step.intersecting)) {
    parting_.push_back(found.pair);
    const std::vector<TrianglePairContact> contacts =
        parted_contacts(input, found.triangle_pairs, found.from, options_.executor);
    step.contacts.insert(step.contacts.end(), contacts.begin(), contacts.end());
    step.sizes.elementary_tests += found.triangle_pairs.size();
  }
}

void StreamsEngine::commit() {
  DISMANTLE_EXPECT(may_commit_);
  backend_->commit();
  part(parting_);
  parting_.clear();
  may_commit_ = false;
}

void StreamsEngine::part(const std::vector<ComponentPair>& parted) {
  if (parted.empty()) return;
  for (const ComponentPair& pair : parted) rules_.part(pair.a, pair.b);
  embedded_.part(parted);
  backend_->set_rules(rules_.view());
}

void StreamsEngine::jump(Span<const RigidTransform> state) {
  backend_->jump(state);
  next_.assign(state.begin(), state.end());
  may_commit_ = false;
  parting_.clear();
  if (!embedded_.pairs().empty()) part(embedded_.apart(embedded_step(backend_->on_host(), 0)));
}

}  // namespace

std::unique_ptr<SweepEngine> make_streams_engine(const Assembly& assembly, const PairStates& pairs,
                                                 const CollisionOptions& options,
                                                 std::unique_ptr<StreamsBackend> backend) {
  return std::make_unique<StreamsEngine>(assembly, pairs, options, std::move(backend));
}

std::unique_ptr<SweepEngine> make_streams_engine(const Assembly& assembly, const PairStates& pairs,
                                                 const CollisionOptions& options) {
  return make_streams_engine(assembly, pairs, options, make_host_streams_backend(assembly, options));
}

}  // namespace dismantle
