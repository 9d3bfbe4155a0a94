// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/path_animations.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace dismantle {

namespace {

/// The animation backwards. @pre every track is as long as the animation
GlbAnimation reversed(GlbAnimation animation) {
  animation.name += ", reversed";
  for (GlbTrack& track : animation.tracks) track.frames = reversed(std::move(track.frames));
  return animation;
}

void add_both(std::vector<GlbAnimation>& animations, GlbAnimation forward, PathDirection first) {
  animations.push_back(reversed(forward));
  animations.push_back(std::move(forward));
  if (first == PathDirection::Forward) std::iter_swap(animations.end() - 2, animations.end() - 1);
}

GlbAnimation whole_animation(const Timeline& timeline) {
  std::map<ComponentId, std::vector<Frame>> frames;
  for (const TimelineMove& move : timeline.moves())
    for (const ComponentId c : move.components)
      for (const Frame& frame : move.frames) frames[c].push_back({move.start + frame.time, frame.pose});
  GlbAnimation all{"all", {}};
  for (auto& [component, list] : frames) {
    list.push_back({timeline.duration(), list.back().pose});
    all.tracks.push_back({component, std::move(list)});
  }
  return all;
}

/// @param poses of all components that move at any time, before this move
GlbAnimation move_animation(const TimelineMove& move, std::size_t number, const std::map<ComponentId, Pose>& poses) {
  const std::set<ComponentId> moving(move.components.begin(), move.components.end());
  GlbAnimation animation{std::to_string(number) + ' ' + move.label, {}};
  for (const auto& [component, pose] : poses)
    animation.tracks.push_back({component, moving.count(component) > 0
                                               ? move.frames
                                               : std::vector<Frame>{{0, pose}, {move.duration(), pose}}});
  return animation;
}

}  // namespace

std::vector<GlbAnimation> path_animations(const Timeline& timeline, PathDirection first) {
  std::vector<GlbAnimation> animations;
  if (timeline.moves().empty()) return animations;
  add_both(animations, whole_animation(timeline), first);

  std::map<ComponentId, Pose> poses;
  for (const TimelineMove& move : timeline.moves())
    for (const ComponentId c : move.components) poses[c] = Pose{};
  for (std::size_t i = 0; i < timeline.moves().size(); ++i) {
    const TimelineMove& move = timeline.moves()[i];
    add_both(animations, move_animation(move, i + 1, poses), first);
    for (const ComponentId c : move.components) poses[c] = move.frames.back().pose;
  }
  return animations;
}

}  // namespace dismantle
