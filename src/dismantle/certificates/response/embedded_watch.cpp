// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/response/embedded_watch.h"

#include "dismantle/engine/chords.h"
#include "dismantle/math/screw.h"
#include "dismantle/streams/sweep_engine.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Attempts to make a motion that is stopped up to its contact.
constexpr int kTries = 4;

}  // namespace

EmbeddedWatch::EmbeddedWatch(const Assembly& assembly, const PairStates& pairs, const Executor& executor) {
  for (const ComponentPair& pair : pairs.pairs) {
    if (pair.state != PairState::Embedded) continue;
    Watched w;
    w.pair = pair;
    w.assembly = std::make_unique<Assembly>();
    w.assembly->components = {assembly[pair.a], assembly[pair.b]};
    PairStates states;
    states.tolerance = pairs.tolerance;
    states.pairs = {pair};
    states.pairs[0].a = ComponentId(0);
    states.pairs[0].b = ComponentId(1);
    CollisionOptions options;
    options.executor = executor;
    w.engine = make_streams_engine(*w.assembly, states, options);
    watched_.push_back(std::move(w));
  }
}

std::vector<ComponentPair> EmbeddedWatch::pairs() const {
  std::vector<ComponentPair> list;
  for (const Watched& w : watched_) list.push_back(w.pair);
  return list;
}

double EmbeddedWatch::follow(const std::vector<bool>& is_moving, Span<const Pose> poses, const ScrewMotion& motion,
                             double max_deviation) {
  std::vector<Watched*> moving;
  for (Watched& w : watched_)
    if (is_moving[w.pair.a.value] != is_moving[w.pair.b.value]) moving.push_back(&w);
  if (moving.empty()) return 1;

  // The fraction of the piece to `next` that all of them allow; nothing is committed.
  const auto sweep = [&](const Pose& next) {
    double toi = 1;
    for (Watched* w : moving) {
      const auto at = [&](ComponentId c) { return transform_from_pose(is_moving[c.value] ? next : poses[c.value]); };
      const RigidTransform state[2] = {at(w->pair.a), at(w->pair.b)};
      const SweepResult found = w->engine->sweep({state, 2}, max_deviation);
      if (!found.free) toi = std::min(toi, found.toi * (1 - kBackoffShare));
    }
    return toi;
  };
  const auto commit = [&] {
    for (Watched* w : moving) w->engine->commit();
  };

  const int cuts = chord_count(motion.deviation, max_deviation);
  for (int k = 0; k < cuts; ++k) {
    double fraction = 1;
    for (int tries = 0; tries < kTries; ++tries) {
      const double allowed = sweep(motion.at((k + fraction) / cuts));
      if (allowed >= 1) break;
      fraction = tries + 1 < kTries ? fraction * allowed : 0;
    }
    if (fraction > 0) commit();
    if (fraction < 1) return (k + fraction) / cuts;
  }
  return 1;
}

void EmbeddedWatch::jump(Span<const Pose> poses) {
  for (Watched& w : watched_) {
    const RigidTransform state[2] = {transform_from_pose(poses[w.pair.a.value]),
                                     transform_from_pose(poses[w.pair.b.value])};
    w.engine->jump({state, 2});
  }
}

std::vector<ComponentPair> EmbeddedWatch::take_parted() {
  std::vector<ComponentPair> parted;
  for (const Watched& w : watched_)
    if (w.engine->embedded_pairs().empty()) parted.push_back(w.pair);
  std::erase_if(watched_, [](const Watched& w) { return w.engine->embedded_pairs().empty(); });
  return parted;
}

}  // namespace dismantle
