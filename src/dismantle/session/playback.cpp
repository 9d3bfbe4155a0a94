// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/playback.h"

#include "dismantle/math/screw.h"

#include <algorithm>
#include <chrono>

namespace dismantle {

namespace {

using Clock = std::chrono::steady_clock;

/// advance() comes back after about this long, wherever it is then.
constexpr std::chrono::milliseconds kMaxTime{8};

/// What is in the way of a set.
ComponentId blocker(const StepResult& step, Span<const ComponentId> set) {
  if (step.contacts.empty()) return {};
  const CollisionContact& c = step.contacts.front();
  return std::find(set.begin(), set.end(), c.a) == set.end() ? c.a : c.b;
}

}  // namespace

Span<const ComponentId> Playback::moving() const {
  if (timeline_.moves().empty()) return {};
  return timeline_.moves()[place_.move].components;
}

void Playback::play(double speed) {
  speed_ = speed;
  playing_ = !timeline_.moves().empty();
  block_.reset();
}

void Playback::seek(double time) {
  place_ = timeline_.place_at(time);
  time_ = timeline_.time_of(place_);
  block_.reset();
}

TimelinePlace Playback::forward(double goal) const {
  const TimelineMove& move = timeline_.moves()[place_.move];
  if (place_.frame + 1 == move.frames.size())
    return place_.move + 1 < timeline_.moves().size() ? TimelinePlace{place_.move + 1, 0, 0} : place_;
  // In the timeline's time, not the move's: their difference is rounded, and the end would never be reached.
  const double from = move.start + move.frames[place_.frame].time;
  const double to = move.start + move.frames[place_.frame + 1].time;
  if (to <= goal) return {place_.move, place_.frame + 1, 0};
  return {place_.move, place_.frame, std::clamp((goal - from) / (to - from), place_.share, 1 - 1e-12)};
}

TimelinePlace Playback::backward(double goal) const {
  if (place_.share == 0 && place_.frame == 0) {
    if (place_.move == 0) return place_;
    return {place_.move - 1, timeline_.moves()[place_.move - 1].frames.size() - 1, 0};
  }
  const TimelineMove& move = timeline_.moves()[place_.move];
  const std::size_t frame = place_.share > 0 ? place_.frame : place_.frame - 1;
  const double from = move.start + move.frames[frame].time, to = move.start + move.frames[frame + 1].time;
  if (from >= goal) return {place_.move, frame, 0};
  if (place_.share == 0 && goal >= to) return place_;
  return {place_.move, frame,
          std::clamp((goal - from) / (to - from), 1e-12, place_.share > 0 ? place_.share : 1 - 1e-12)};
}

TimelinePlace Playback::next_place(double goal) const {
  return speed_ > 0 ? forward(goal) : backward(goal);
}

bool Playback::is_excused(const StepResult& step, std::size_t move) const {
  const PairList& embedded = timeline_.moves()[move].embedded_before;
  return !step.contacts.empty() && std::all_of(step.contacts.begin(), step.contacts.end(), [&](const auto& c) {
    return std::binary_search(embedded.begin(), embedded.end(), std::pair(std::min(c.a, c.b), std::max(c.a, c.b)));
  });
}

void Playback::put(MotionEngine& engine, const TimelinePlace& place) const {
  engine.jump(timeline_.poses_at(place, component_count_));
  engine.hold(timeline_.moves()[place.move].components);
}

bool Playback::is_free_the_other_way(MotionEngine& engine, const TimelinePlace& next) const {
  put(engine, next);
  const bool is_free = engine.step(timeline_.pose_of(place_), ResponseKind::Stop).reached;
  put(engine, place_);
  return is_free;
}

bool Playback::is_free_by_sliding(MotionEngine& engine, const TimelinePlace& next) const {
  if (!engine.can_respond(ResponseKind::Slide)) return false;
  const Pose wanted = timeline_.pose_of(next);
  const Pose got = engine.step(wanted, ResponseKind::Slide).pose;
  double lever = 0;
  for (const ComponentId c : timeline_.moves()[next.move].components) {
    const Aabb box = assembled_bounds((*assembly_)[c]);
    lever = std::max(lever, length(max(max(box.upper, -box.upper), max(box.lower, -box.lower))));
  }
  const double off = length(wanted.position - got.position) + lever * screw_between(got, wanted).angle;
  return off <= tolerance_;
}

bool Playback::go(MotionEngine& engine, const TimelinePlace& next, StepResult& result) {
  const std::vector<ComponentId>& set = timeline_.moves()[next.move].components;
  if (next.move != place_.move) {
    engine.hold(set);
    place_ = next;
    return true;  // the last pose of the one move is the first of the other
  }
  const Pose pose = timeline_.pose_of(next);
  result = engine.step(pose, ResponseKind::Stop);
  if (!result.reached) {
    const bool excused =
        is_excused(result, next.move) || is_free_the_other_way(engine, next) || is_free_by_sliding(engine, next);
    if (!excused && !block_) block_ = PlaybackBlock{timeline_.time_of(place_), blocker(result, set)};
    if (!excused && source_ == PlaybackSource::Guide) {
      put(engine, place_);
      return false;
    }
    put(engine, next);
    result.pose = pose;
    result.way = {pose};
  }
  place_ = next;
  return true;
}

StepResult Playback::advance(MotionEngine& engine, double dt) {
  StepResult result;
  const Clock::time_point end = Clock::now() + kMaxTime;
  const double goal = std::clamp(time_ + speed_ * dt, 0.0, timeline_.duration());
  engine.hold(moving());
  bool is_there = false;
  while (!is_there && Clock::now() < end) {
    const TimelinePlace next = next_place(goal);
    if (next == place_) {
      is_there = true;
    } else if (!go(engine, next, result)) {
      playing_ = false;
      break;
    } else {
      is_there = place_.share > 0;
    }
  }
  time_ = is_there ? goal : timeline_.time_of(place_);
  const bool at_end = speed_ > 0 ? place_ == timeline_.end() : place_ == TimelinePlace{};
  if (is_there && at_end) playing_ = false;
  result.pose = timeline_.pose_of(place_);
  return result;
}

}  // namespace dismantle
