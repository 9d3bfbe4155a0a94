// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/motion_engine.h"
#include "dismantle/session/timeline.h"

#include <optional>

namespace dismantle {

/// The source of a playback.
enum class PlaybackSource {
  Recording,  ///< The recording of the session: each motion was free when it was made.
  Guide,      ///< A path file, which has not been checked.
};

/// The position at which a playback was blocked.
struct PlaybackBlock {
  double time = 0;  ///< [s]
  ComponentId by;   ///< The blocking component; invalid if the engine named none.
};

/// Plays a timeline with an engine, forward or backward at any speed. It passes through every frame, bit for bit, and
/// the engine checks every screw motion again. If a motion is blocked, the block is kept: a guide ends there; a
/// recording goes on, as it was free when it was recorded.
class Playback {
 public:
  /// A paused playback at the start. @param tolerance [mm]; `assembly` must outlive this
  Playback(PlaybackSource source, Timeline timeline, const Assembly& assembly, double tolerance)
      : source_(source),
        timeline_(std::move(timeline)),
        assembly_(&assembly),
        component_count_(assembly.components.size()),
        tolerance_(tolerance) {}

  /// The source of the playback.
  PlaybackSource source() const { return source_; }
  /// Its moves.
  const Timeline& timeline() const { return timeline_; }
  /// The present position.
  const TimelinePosition& position() const { return position_; }
  /// The present time [s].
  double time() const { return time_; }
  /// The speed relative to real time; negative: backward.
  double speed() const { return speed_; }
  /// True until pause() or either end.
  bool is_playing() const { return playing_; }
  /// The first position at which the playback was blocked, if any.
  const std::optional<PlaybackBlock>& block() const { return block_; }
  /// The poses at the present position, one for each component.
  std::vector<Pose> poses() const { return timeline_.poses_at(position_, component_count_); }
  /// For each component, whether it is removed at the present position.
  std::vector<bool> removed() const { return timeline_.removed_at(position_, component_count_); }
  /// The moving set of the present move; empty if there is none.
  Span<const ComponentId> moving() const;

  /// Starts playing; backward if `speed` is negative.
  void play(double speed);
  /// Stops at the present position.
  void pause() { playing_ = false; }
  /// Jumps to a time [s] without a motion: the caller puts the engine to poses().
  void seek(double time);
  /// Advances by `dt` [s of real time] times the speed; by less if that takes the engine too long. Stops at either end.
  /// @pre the engine's poses are poses()
  StepResult advance(MotionEngine& engine, double dt);

 private:
  /// The next position towards the time `goal`, at most one frame further; position_ if there is none.
  TimelinePosition next_position(double goal) const;
  TimelinePosition forward(double goal) const;
  TimelinePosition backward(double goal) const;
  bool go(MotionEngine& engine, const TimelinePosition& next, StepResult& result);
  /// The engine is conservative, depending on its state. A motion that it blocks as one sweep is accepted if the
  /// reversed screw is free, or if the set slides to within the tolerance of its end.
  bool is_free_the_other_way(MotionEngine& engine, const TimelinePosition& next) const;
  bool is_free_by_sliding(MotionEngine& engine, const TimelinePosition& next) const;
  void put(MotionEngine& engine, const TimelinePosition& position) const;

  PlaybackSource source_;
  Timeline timeline_;
  const Assembly* assembly_;
  std::size_t component_count_;
  double tolerance_;
  TimelinePosition position_;
  double time_ = 0, speed_ = 1;
  bool playing_ = false;
  std::optional<PlaybackBlock> block_;
};

}  // namespace dismantle
