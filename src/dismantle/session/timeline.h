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
  std::string label;
  std::vector<ComponentId> components;
  std::vector<Frame> frames;  ///< At least one.
  double start = 0;           ///< [s]
  PairList embedded_before;   ///< Pairs that may be embedded in it.
  std::optional<bool> removed_after;
  double duration() const { return frames.back().time; }
};

/// Where on a timeline something is: on the screw from frame `frame` of move `move` to the next, after this share of
/// it.
struct TimelinePlace {
  std::size_t move = 0, frame = 0;
  double share = 0;  ///< in [0, 1)
  friend bool operator==(const TimelinePlace&, const TimelinePlace&) = default;
};

/// A recording or a path file, its moves one after another in time.
class Timeline {
 public:
  static Timeline of_entries(Span<const SessionEntry> entries);
  /// Errors: Unreadable where the path does not fit the assembly: unknown names, a set that is torn, a move that does
  /// not begin where its components are.
  static Result<Timeline> of_path(const Assembly& assembly, const PairStates& pairs, const Path& path);

  const std::vector<TimelineMove>& moves() const { return moves_; }
  double duration() const { return moves_.empty() ? 0 : moves_.back().start + moves_.back().duration(); }
  TimelinePlace end() const;
  /// The last place at `time` [s]; the beginning or the end where it is outside.
  TimelinePlace place_at(double time) const;
  double time_of(const TimelinePlace& place) const;
  Pose pose_of(const TimelinePlace& place) const;
  /// Where every component is then, all assembled at the beginning.
  std::vector<Pose> poses_at(const TimelinePlace& place, std::size_t component_count) const;
  /// Which are taken away then.
  std::vector<bool> removed_at(const TimelinePlace& place, std::size_t component_count) const;

 private:
  void add(TimelineMove move);

  std::vector<TimelineMove> moves_;
};

/// How far a move of a path file may begin from where its components are, in position and quaternion; an exporter may
/// round, but nothing jumps.
inline constexpr double kTimelineJoin = 1e-6;

}  // namespace dismantle
