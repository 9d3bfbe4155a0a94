// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/motion_engine.h"
#include "dismantle/session/timeline.h"

#include <optional>

namespace dismantle {

/// What a playback plays.
enum class PlaybackSource {
  Recording,  ///< What the session let happen: each motion of it was let through when it was made.
  Guide,      ///< A path file, of which nothing is known.
};

/// Where the engine did not let a playback through.
struct PlaybackBlock {
  double time = 0;  ///< [s]
  ComponentId by;   ///< What was in the way; invalid where the engine named nothing.
};

/// A timeline that is played with an engine, forward or backward at any speed: it passes through every frame, bit for
/// bit, and has the engine check every screw anew. Where the engine does not let a motion through, that is kept: a
/// guide ends there; a recording goes on (the way back along a free motion is free, and so is a pair that was embedded
/// when it was made).
class Playback {
 public:
  /// @param tolerance [mm]; `assembly` must outlive this
  Playback(PlaybackSource source, Timeline timeline, const Assembly& assembly, double tolerance)
      : source_(source),
        timeline_(std::move(timeline)),
        assembly_(&assembly),
        component_count_(assembly.components.size()),
        tolerance_(tolerance) {}

  PlaybackSource source() const { return source_; }
  const Timeline& timeline() const { return timeline_; }
  const TimelinePlace& place() const { return place_; }
  double time() const { return time_; }
  double speed() const { return speed_; }
  bool is_playing() const { return playing_; }
  const std::optional<PlaybackBlock>& block() const { return block_; }
  /// The poses and what is taken away where it is.
  std::vector<Pose> poses() const { return timeline_.poses_at(place_, component_count_); }
  std::vector<bool> removed() const { return timeline_.removed_at(place_, component_count_); }
  /// The set of the present move; empty where there is none.
  Span<const ComponentId> moving() const;

  /// Backward where `speed` is negative.
  void play(double speed);
  void pause() { playing_ = false; }
  /// Is there, without a way: the engine has to be put to poses().
  void seek(double time);
  /// Plays on by `dt` [s of the hand's time] times the speed; less where that takes the engine too long. Stops at
  /// either end.
  /// @pre the engine's poses are poses()
  StepResult advance(MotionEngine& engine, double dt);

 private:
  /// The next place towards `goal`, at most one frame on; place_ itself where there is none.
  TimelinePlace next_place(double goal) const;
  TimelinePlace forward(double goal) const;
  TimelinePlace backward(double goal) const;
  bool go(MotionEngine& engine, const TimelinePlace& next, StepResult& result);
  bool is_excused(const StepResult& step, std::size_t move) const;
  /// The engine decides with some slack, by what it has seen before. What it does not let through as one sweep is
  /// confirmed where the same screw is free the other way, or where the set slides to within the tolerance of its end.
  bool is_free_the_other_way(MotionEngine& engine, const TimelinePlace& next) const;
  bool is_free_by_sliding(MotionEngine& engine, const TimelinePlace& next) const;
  void put(MotionEngine& engine, const TimelinePlace& place) const;

  PlaybackSource source_;
  Timeline timeline_;
  const Assembly* assembly_;
  std::size_t component_count_;
  double tolerance_;
  TimelinePlace place_;
  double time_ = 0, speed_ = 1;
  bool playing_ = false;
  std::optional<PlaybackBlock> block_;
};

}  // namespace dismantle
