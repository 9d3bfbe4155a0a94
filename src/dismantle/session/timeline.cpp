// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/timeline.h"

#include "dismantle/math/screw.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

bool nearly_equal(const Pose& a, const Pose& b) {
  const double q = std::fabs(dot(a.rotation, b.rotation));
  return max_abs(a.position - b.position) <= kTimelineJoin && 1 - q <= kTimelineJoin;
}

Error does_not_fit(std::size_t move, const std::string& why) {
  return {ErrorKind::Unreadable, "the path cannot be played (moves[" + std::to_string(move) + "] " + why +
                                     "); take a path of this assembly that 'dismantle audit' accepts"};
}

Result<std::vector<ComponentId>> find_set(const Assembly& assembly, const Move& move, std::size_t index) {
  std::vector<ComponentId> ids;
  for (const std::string& name : move.components) {
    const std::optional<ComponentId> id = assembly.find(name);
    if (!id) return does_not_fit(index, "moves '" + name + "', which the assembly does not have");
    ids.push_back(*id);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (ids.empty() || move.frames.empty()) return does_not_fit(index, "moves nothing");
  return ids;
}

}  // namespace

void Timeline::add(TimelineMove move) {
  move.start = duration();
  moves_.push_back(std::move(move));
}

Timeline Timeline::of_entries(Span<const SessionEntry> entries) {
  Timeline timeline;
  for (const SessionEntry& e : entries) timeline.add({e.label, e.components, e.frames, 0, e.removed_after});
  return timeline;
}

Result<Timeline> Timeline::of_path(const Assembly& assembly, const Path& path) {
  Timeline timeline;
  std::vector<Pose> poses(assembly.components.size());
  for (std::size_t i = 0; i < path.moves.size(); ++i) {
    const Move& move = path.moves[i];
    const Result<std::vector<ComponentId>> set = find_set(assembly, move, i);
    if (!set) return set.error();
    for (const ComponentId c : *set) {
      if (!nearly_equal(poses[c.value], move.frames.front().pose))
        return does_not_fit(i, "does not begin where '" + assembly[c].name + "' is then");
      poses[c.value] = move.frames.back().pose;
    }
    timeline.add({move.label, *set, move.frames, 0, {}});
  }
  return timeline;
}

TimelinePosition Timeline::end() const {
  if (moves_.empty()) return {};
  return {moves_.size() - 1, moves_.back().frames.size() - 1, 0};
}

TimelinePosition Timeline::position_at(double time) const {
  if (moves_.empty() || time <= 0) return {};
  if (time >= duration()) return end();
  const auto next =
      std::upper_bound(moves_.begin(), moves_.end(), time, [](double t, const TimelineMove& m) { return t < m.start; });
  TimelinePosition position;
  position.move = static_cast<std::size_t>(next - moves_.begin()) - 1;
  const TimelineMove& move = moves_[position.move];
  const double local = time - move.start;
  const auto later = std::upper_bound(move.frames.begin(), move.frames.end(), local,
                                      [](double t, const Frame& f) { return t < f.time; });
  position.frame = static_cast<std::size_t>(later - move.frames.begin()) - 1;
  if (later != move.frames.end()) {
    const double before = move.frames[position.frame].time;
    position.share = (local - before) / (later->time - before);
  }
  return position;
}

double Timeline::time_of(const TimelinePosition& position) const {
  if (moves_.empty()) return 0;
  const TimelineMove& move = moves_[position.move];
  double time = move.frames[position.frame].time;
  if (position.share > 0) time += position.share * (move.frames[position.frame + 1].time - time);
  return move.start + time;
}

Pose Timeline::pose_of(const TimelinePosition& position) const {
  const std::vector<Frame>& frames = moves_[position.move].frames;
  if (position.share == 0) return frames[position.frame].pose;
  return pose_between(frames[position.frame].pose, frames[position.frame + 1].pose, position.share);
}

std::vector<Pose> Timeline::poses_at(const TimelinePosition& position, std::size_t component_count) const {
  std::vector<Pose> poses(component_count);
  if (moves_.empty()) return poses;
  for (std::size_t i = 0; i < position.move; ++i)
    for (const ComponentId c : moves_[i].components) poses[c.value] = moves_[i].frames.back().pose;
  for (const ComponentId c : moves_[position.move].components) poses[c.value] = pose_of(position);
  return poses;
}

std::vector<bool> Timeline::removed_at(const TimelinePosition& position, std::size_t component_count) const {
  std::vector<bool> removed(component_count, false);
  for (std::size_t i = 0; i < moves_.size() && i <= position.move; ++i) {
    const bool is_over = i < position.move || position.frame + 1 == moves_[i].frames.size();
    // Returned components are present from the start of their move; removed ones are gone at its end.
    if (!moves_[i].removed_after || (*moves_[i].removed_after && !is_over)) continue;
    for (const ComponentId c : moves_[i].components) removed[c.value] = *moves_[i].removed_after;
  }
  return removed;
}

}  // namespace dismantle
