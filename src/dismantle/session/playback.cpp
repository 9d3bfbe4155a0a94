// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/playback.h"

#include "dismantle/math/screw.h"
#include "dismantle/session/step_limit.h"

#include <algorithm>
#include <chrono>

namespace dismantle {

namespace {

using Clock = std::chrono::steady_clock;

/// advance() returns after about this long.
constexpr std::chrono::milliseconds kMaxTime{8};

/// The component that blocks a set.
ComponentId blocker(const StepResult& step, Span<const ComponentId> set) {
  if (step.blocking_pairs.empty()) return {};
  const BlockingPair& c = step.blocking_pairs.front();
  return std::find(set.begin(), set.end(), c.a) == set.end() ? c.a : c.b;
}

}  // namespace

Span<const ComponentId> Playback::moving() const {
  if (timeline_.moves().empty()) return {};
  return timeline_.moves()[position_.move].components;
}

void Playback::play(double speed) {
  speed_ = speed;
  playing_ = !timeline_.moves().empty();
  block_.reset();
}

void Playback::seek(double time) {
  position_ = timeline_.position_at(time);
  time_ = timeline_.time_of(position_);
  block_.reset();
}

TimelinePosition Playback::forward(double goal) const {
  const TimelineMove& move = timeline_.moves()[position_.move];
  if (position_.frame + 1 == move.frames.size())
    return position_.move + 1 < timeline_.moves().size() ? TimelinePosition{position_.move + 1, 0, 0} : position_;
  // In the timeline's time, not the move's: with rounded differences the end might never be reached.
  const double from = move.start + move.frames[position_.frame].time;
  const double to = move.start + move.frames[position_.frame + 1].time;
  if (to <= goal) return {position_.move, position_.frame + 1, 0};
  return {position_.move, position_.frame, std::clamp((goal - from) / (to - from), position_.share, 1 - 1e-12)};
}

TimelinePosition Playback::backward(double goal) const {
  if (position_.share == 0 && position_.frame == 0) {
    if (position_.move == 0) return position_;
    return {position_.move - 1, timeline_.moves()[position_.move - 1].frames.size() - 1, 0};
  }
  const TimelineMove& move = timeline_.moves()[position_.move];
  const std::size_t frame = position_.share > 0 ? position_.frame : position_.frame - 1;
  const double from = move.start + move.frames[frame].time, to = move.start + move.frames[frame + 1].time;
  if (from >= goal) return {position_.move, frame, 0};
  if (position_.share == 0 && goal >= to) return position_;
  return {position_.move, frame,
          std::clamp((goal - from) / (to - from), 1e-12, position_.share > 0 ? position_.share : 1 - 1e-12)};
}

TimelinePosition Playback::next_position(double goal) const {
  return speed_ > 0 ? forward(goal) : backward(goal);
}

void Playback::put(MotionEngine& engine, const TimelinePosition& position) const {
  engine.jump(timeline_.poses_at(position, component_count_));
  engine.grab(timeline_.moves()[position.move].components);
}

bool Playback::is_free_the_other_way(MotionEngine& engine, const TimelinePosition& next) const {
  put(engine, next);
  const bool is_free = whole_step(engine, timeline_.pose_of(position_), ResponseKind::Stop).reached;
  put(engine, position_);
  return is_free;
}

bool Playback::is_free_by_sliding(MotionEngine& engine, const TimelinePosition& next) const {
  if (!engine.can_respond(ResponseKind::Slide)) return false;
  const Pose wanted = timeline_.pose_of(next);
  const Pose got = whole_step(engine, wanted, ResponseKind::Slide).pose;
  double lever = 0;
  for (const ComponentId c : timeline_.moves()[next.move].components) {
    const Aabb box = assembled_bounds((*assembly_)[c]);
    lever = std::max(lever, length(max(max(box.upper, -box.upper), max(box.lower, -box.lower))));
  }
  const double off = length(wanted.position - got.position) + lever * screw_between(got, wanted).angle;
  return off <= tolerance_;
}

bool Playback::go(MotionEngine& engine, const TimelinePosition& next, StepResult& result) {
  const std::vector<ComponentId>& set = timeline_.moves()[next.move].components;
  if (next.move != position_.move) {
    engine.grab(set);
    position_ = next;
    return true;  // the last pose of the one move is the first of the other
  }
  const Pose pose = timeline_.pose_of(next);
  result = whole_step(engine, pose, ResponseKind::Stop);
  if (!result.reached) {
    const bool is_free = is_free_the_other_way(engine, next) || is_free_by_sliding(engine, next);
    if (!is_free && !block_) block_ = PlaybackBlock{timeline_.time_of(position_), blocker(result, set)};
    if (!is_free && source_ == PlaybackSource::Guide) {
      put(engine, position_);
      return false;
    }
    put(engine, next);
    result.pose = pose;
    result.poses = {pose};
  }
  position_ = next;
  return true;
}

StepResult Playback::advance(MotionEngine& engine, double dt) {
  StepResult result;
  const Clock::time_point end = Clock::now() + kMaxTime;
  const double goal = std::clamp(time_ + speed_ * dt, 0.0, timeline_.duration());
  engine.grab(moving());
  bool is_there = false;
  while (!is_there && Clock::now() < end) {
    const TimelinePosition next = next_position(goal);
    if (next == position_) {
      is_there = true;
    } else if (!go(engine, next, result)) {
      playing_ = false;
      break;
    } else {
      is_there = position_.share > 0;
    }
  }
  time_ = is_there ? goal : timeline_.time_of(position_);
  const bool at_end = speed_ > 0 ? position_ == timeline_.end() : position_ == TimelinePosition{};
  if (is_there && at_end) playing_ = false;
  result.pose = timeline_.pose_of(position_);
  return result;
}

}  // namespace dismantle
