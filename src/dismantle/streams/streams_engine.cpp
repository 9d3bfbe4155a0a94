// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/embedded_pairs.h"
#include "dismantle/streams/guarded_pairs.h"
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
        tolerance_(pairs.tolerance),
        guards_(assembly, pairs, backend_->fixed(), options),
        embedded_(assembly, pairs),
        next_(state().begin(), state().end()) {
    backend_->set_ghosts(guards_.ghosts());
    backend_->set_rules(guards_.rules());
  }

  SweepResult sweep(Span<const RigidTransform> next, double path_deviation) override;
  void commit() override;
  void jump(Span<const RigidTransform> state) override;
  Span<const RigidTransform> state() const override { return backend_->state(); }
  std::vector<ComponentPair> overlapping_pairs() const override;

 private:
  EmbeddedStep embedded_step(const MovingStreams& streams, double path_deviation) const;
  void test_embedded_pairs(StreamsStep& step, double path_deviation);
  void end_free(const std::vector<ComponentPair>& parted);

  CollisionOptions options_;
  std::unique_ptr<StreamsBackend> backend_;
  double tolerance_;
  GuardedPairs guards_;
  EmbeddedPairs embedded_;  // S_i
  std::vector<RigidTransform> next_;
  std::vector<ComponentPair> parting_;  // pairs that leave S_i if the last sweep is committed
  bool may_commit_ = false;
};

SweepResult StreamsEngine::sweep(Span<const RigidTransform> next, double path_deviation) {
  DISMANTLE_EXPECT(2 * path_deviation <= tolerance_);
  StageClock clock;
  parting_.clear();
  next_.assign(next.begin(), next.end());

  if (guards_.begin_motion(state(), next_)) backend_->set_rules(guards_.rules());
  StreamsStep step = backend_->step(next);
  StageClock pairs_clock;
  test_embedded_pairs(step, path_deviation);
  std::vector<BlockingPair> blocking = blocking_pairs(backend_->fixed(), step.contacts);
  const std::vector<BlockingPair> deep = guards_.too_deep(state(), next_);
  blocking.insert(blocking.end(), deep.begin(), deep.end());
  SweepResult result;
  result.blocking_pairs = first_of(std::move(blocking));
  step.timings.intersection += pairs_clock.total();

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
  const NarrowPhaseInput input{backend_->triangle_pairs(), &streams, guards_.rules(), options_.test, &guards_.ghosts()};
  const NarrowPhaseKernel kernel = narrow_phase_kernel(input);
  for (const PartingPair& found :
       embedded_.parting(embedded_step(streams, path_deviation), input.triangle_pairs, step.intersecting)) {
    const auto contacts = contacts_after(found, kernel, options_.executor);
    if (!contacts) continue;
    parting_.push_back(found.pair);
    step.contacts.insert(step.contacts.end(), contacts->begin(), contacts->end());
    step.sizes.elementary_tests += found.triangle_pairs.size();
  }
}

void StreamsEngine::commit() {
  DISMANTLE_EXPECT(may_commit_);
  const std::vector<RigidTransform> start(state().begin(), state().end());
  backend_->commit();
  end_free(parting_);
  parting_.clear();
  if (guards_.part(start, state())) backend_->set_rules(guards_.rules());
  may_commit_ = false;
}

void StreamsEngine::end_free(const std::vector<ComponentPair>& parted) {
  if (parted.empty()) return;
  for (const ComponentPair& pair : parted) guards_.end_free(pair.a, pair.b);
  embedded_.part(parted);
  backend_->set_rules(guards_.rules());
}

void StreamsEngine::jump(Span<const RigidTransform> state) {
  backend_->jump(state);
  next_.assign(state.begin(), state.end());
  may_commit_ = false;
  parting_.clear();
  if (!embedded_.pairs().empty()) end_free(embedded_.apart(embedded_step(backend_->on_host(), 0)));
  if (guards_.jump(state)) backend_->set_rules(guards_.rules());
}

std::vector<ComponentPair> StreamsEngine::overlapping_pairs() const {
  std::vector<ComponentPair> pairs = guards_.overlapping();
  pairs.insert(pairs.end(), embedded_.pairs().begin(), embedded_.pairs().end());
  std::sort(pairs.begin(), pairs.end(),
            [](const ComponentPair& x, const ComponentPair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  return pairs;
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
