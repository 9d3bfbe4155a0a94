// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/collision_engine.h"
#include "dismantle/collision/moving_streams.h"
#include "dismantle/collision/narrow_phase.h"
#include "dismantle/collision/parting.h"
#include "dismantle/front/front.h"

#include <algorithm>
#include <chrono>

namespace dismantle {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Gives the time since it was last asked [ms].
class StageClock {
 public:
  double lap() {
    const Clock::time_point now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  Clock::time_point last_ = Clock::now();
};

/// The longest way that a vertex of the box goes from one transform to the other; of all points of a box a corner
/// goes furthest.
double longest_way(const Aabb& box, const RigidTransform& start, const RigidTransform& end) {
  double longest = 0;
  for (int i = 0; i < 8 && !box.empty(); ++i) {
    const Vec3 corner{i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                      i & 4 ? box.upper.z : box.lower.z};
    longest = std::max(longest, length(end * corner - start * corner));
  }
  return longest * (1 + 1e-9);
}

/// Du et al. 2015, algorithm 1, one step at a time.
class StreamsEngine final : public CollisionEngine {
 public:
  StreamsEngine(const Assembly& assembly, const PairStates& pairs, const CollisionOptions& options)
      : options_(options),
        streams_(assembly, options.executor),
        front_(options.initial_capacity),
        narrow_phase_(options.initial_capacity),
        rules_(pairs),
        next_(streams_.state().begin(), streams_.state().end()) {
    for (const ComponentPair& pair : pairs.pairs)
      if (pair.state == PairState::Embedded) embedded_.push_back(pair);
    for (const Component& c : assembly.components) {
      closed_.push_back(c.faults.closed());
      boxes_.push_back(assembled_bounds(c));
    }
  }

  SweepResult sweep(Span<const RigidTransform> next, double path_deviation) override;
  void commit() override;
  void jump(Span<const RigidTransform> state) override;
  Span<const RigidTransform> state() const override { return streams_.state(); }
  std::vector<ComponentPair> embedded_pairs() const override { return embedded_; }

 private:
  NarrowPhaseInput narrow_phase_input(double path_deviation) const;
  EmbeddedMotion embedded_motion(const ComponentPair& pair, double path_deviation) const;
  void test_embedded_pairs(const NarrowPhaseInput& input);
  void part(const std::vector<ComponentPair>& parted);
  std::vector<CollisionContact> contacts() const;

  CollisionOptions options_;
  MovingStreams streams_;
  Front front_;
  NarrowPhase narrow_phase_;
  PairRules rules_;
  std::vector<bool> closed_;
  std::vector<Aabb> boxes_;  // of the components in the assembled state
  std::vector<RigidTransform> next_;
  std::vector<ComponentPair> embedded_;  // S_i
  std::vector<ComponentPair> parting_;   // those that leave S_i if the last sweep is committed
  bool may_commit_ = false;
};

NarrowPhaseInput StreamsEngine::narrow_phase_input(double path_deviation) const {
  return {front_.triangle_pairs(), &streams_, rules_.view(), options_.test, path_deviation};
}

SweepResult StreamsEngine::sweep(Span<const RigidTransform> next, double path_deviation) {
  DISMANTLE_EXPECT(2 * path_deviation <= rules_.tolerance());
  const Clock::time_point start = Clock::now();
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
  result.contacts = contacts();
  result.timings.intersection = clock.lap();

  for (const CollisionContact& contact : result.contacts) result.toi = std::min(result.toi, contact.toi);
  result.free = result.contacts.empty();
  result.sizes = {front_.size(), front_.triangle_pairs().size(), embedded_.size(), narrow_phase_.tests(),
                  update.replays + narrow_phase_.replays()};
  may_commit_ = result.free;
  result.timings.overall = milliseconds_since(start);
  return result;
}

EmbeddedMotion StreamsEngine::embedded_motion(const ComponentPair& pair, double path_deviation) const {
  EmbeddedMotion motion;
  motion.streams = &streams_.fixed();
  motion.step = {streams_.vertices_t0(), streams_.vertices_t1(), streams_.fixed().faces};
  motion.bounds = streams_.bounds();
  motion.a = pair.a;
  motion.b = pair.b;
  motion.a_closed = closed_[pair.a.value];
  motion.b_closed = closed_[pair.b.value];
  for (const ComponentId c : {pair.a, pair.b})
    motion.displacement += longest_way(boxes_[c.value], streams_.state()[c.value], next_[c.value]);
  motion.tolerance = rules_.tolerance();
  motion.path_deviation = path_deviation;
  return motion;
}

void StreamsEngine::test_embedded_pairs(const NarrowPhaseInput& input) {
  for (const ComponentPair& pair : embedded_) {
    if (streams_.motion_class()[pair.a.value] == streams_.motion_class()[pair.b.value]) continue;
    EmbeddedMotion motion = embedded_motion(pair, input.path_deviation);
    const std::vector<std::uint64_t> intersecting = narrow_phase_.intersections_of(input, pair.a, pair.b);
    motion.intersecting_at_end = intersecting;
    if (pierced_throughout(motion)) continue;
    const std::vector<std::uint64_t> pairs = triangle_pairs_of(input.triangle_pairs, streams_, pair.a, pair.b);
    motion.triangle_pairs = pairs;
    const std::optional<double> from = parted_from(motion);
    if (!from) continue;
    parting_.push_back(pair);
    narrow_phase_.run_part(input, pairs, *from, options_.executor);
  }
}

std::vector<CollisionContact> StreamsEngine::contacts() const {
  const TriangleStreams& fixed = streams_.fixed();
  std::vector<CollisionContact> result;
  for (const TrianglePairContact& found : narrow_phase_.first_contacts()) {
    const NodePair p = pair_of_key(found.key);
    result.push_back({ComponentId(fixed.bvh.component_of[p.a]), ComponentId(fixed.bvh.component_of[p.b]),
                      fixed.face_of[p.a], fixed.face_of[p.b], found.toi});
  }
  std::sort(result.begin(), result.end(), [](const CollisionContact& x, const CollisionContact& y) {
    if (x.a != y.a) return x.a < y.a;
    if (x.b != y.b) return x.b < y.b;
    return x.face_a != y.face_a ? x.face_a < y.face_a : x.face_b < y.face_b;
  });
  return result;
}

void StreamsEngine::commit() {
  DISMANTLE_EXPECT(may_commit_);
  streams_.commit();
  part(parting_);
  parting_.clear();
  may_commit_ = false;
}

void StreamsEngine::part(const std::vector<ComponentPair>& parted) {
  for (const ComponentPair& pair : parted) {
    rules_.part(pair.a, pair.b);
    std::erase_if(embedded_, [&](const ComponentPair& e) { return e.a == pair.a && e.b == pair.b; });
  }
}

void StreamsEngine::jump(Span<const RigidTransform> state) {
  streams_.jump(state, options_.executor);
  next_.assign(state.begin(), state.end());
  may_commit_ = false;
  parting_.clear();
  std::vector<ComponentPair> apart;
  for (const ComponentPair& pair : embedded_) {
    EmbeddedMotion motion = embedded_motion(pair, 0);
    std::vector<std::uint64_t> pairs;
    const std::vector<BvhComponent>& components = streams_.fixed().bvh.components;
    const NodeIndex root_a = components[pair.a.value].root, root_b = components[pair.b.value].root;
    if (root_a != kNoNode && root_b != kNoNode)
      bvh_traverse(BvhView(streams_.fixed().bvh), streams_.bounds(), {root_a, root_b},
                   [&](NodeIndex a, NodeIndex b) { pairs.push_back(pair_key(a, b)); });
    motion.triangle_pairs = pairs;
    if (!components_intersect(motion, 0)) apart.push_back(pair);
  }
  part(apart);
}

}  // namespace

std::unique_ptr<CollisionEngine> make_streams_engine(const Assembly& assembly, const PairStates& pairs,
                                                     const CollisionOptions& options) {
  return std::make_unique<StreamsEngine>(assembly, pairs, options);
}

}  // namespace dismantle
