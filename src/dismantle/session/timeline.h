// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/core/span.h"
#include "dismantle/session/session_entry.h"

#include <string>
#include <vector>

namespace dismantle {

/// A move on a timeline.
struct TimelineMove {
  std::string label;                    ///< For people: "remove screw".
  std::vector<ComponentId> components;  ///< The moving set.
  std::vector<Frame> frames;            ///< At least one.
  double start = 0;                     ///< [s]
  std::optional<bool> removed_after;    ///< Removed after the move; none: unchanged.
  /// [s]
  double duration() const { return frames.back().time; }
};

/// A position on a timeline: on the screw motion from frame `frame` of move `move` to the next one.
struct TimelinePosition {
  std::size_t move = 0;   ///< Index of the move.
  std::size_t frame = 0;  ///< Index of the frame within it.
  double share = 0;       ///< Of the screw motion, in [0, 1).
  friend bool operator==(const TimelinePosition&, const TimelinePosition&) = default;
};

/// The moves of a recording or a path file, one after another in time.
class Timeline {
 public:
  /// The timeline of a recording.
  static Timeline of_entries(Span<const SessionEntry> entries);
  /// The timeline of a path. Errors: Unreadable if the path does not fit the assembly: unknown names, a set with
  /// different poses, a move that does not start at the poses of its components.
  static Result<Timeline> of_path(const Assembly& assembly, const Path& path);

  /// In order.
  const std::vector<TimelineMove>& moves() const { return moves_; }
  /// Of all moves [s].
  double duration() const { return moves_.empty() ? 0 : moves_.back().start + moves_.back().duration(); }
  /// The last position.
  TimelinePosition end() const;
  /// The last position at `time` [s]; the start or the end if it is outside.
  TimelinePosition position_at(double time) const;
  /// The time of a position [s].
  double time_of(const TimelinePosition& position) const;
  /// The pose of the moving set at a position.
  Pose pose_of(const TimelinePosition& position) const;
  /// The pose of every component at a position; all are assembled at the start.
  std::vector<Pose> poses_at(const TimelinePosition& position, std::size_t component_count) const;
  /// For each component, whether it is removed at a position.
  std::vector<bool> removed_at(const TimelinePosition& position, std::size_t component_count) const;

 private:
  void add(TimelineMove move);

  std::vector<TimelineMove> moves_;
};

/// Largest difference between the first frame of a move of a path file and the poses of its components, in position
/// [mm] and quaternion: allows for rounding by exporters.
inline constexpr double kTimelineJoin = 1e-6;

}  // namespace dismantle
