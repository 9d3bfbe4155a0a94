// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/restored_state.h"

#include "dismantle/session/session_path.h"
#include "dismantle/surface/depth/solid_depth.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace dismantle {

namespace {

/// How closely depths are found, and how much deeper than allowed a pair must be to count, relative to the tolerance:
/// the slack of the audit.
constexpr double kSlack = 0.1;

/// The pairs that are too deep at poses that change.
class DepthCheck {
 public:
  DepthCheck(const Assembly& assembly, const PairStates& pairs)
      : assembly_(assembly), pairs_(pairs), poses_(assembly.components.size()) {
    for (const Component& component : assembly.components) bounds_.push_back(bounds_at(component, Pose{}));
  }

  void put(const SessionEntry& entry, const Pose& pose) {
    for (const ComponentId c : entry.components) {
      poses_[c.value] = pose;
      bounds_[c.value] = bounds_at(assembly_[c], pose);
    }
  }

  /// Finds the depths of all pairs of a component anew.
  void check(ComponentId c) {
    for (std::uint32_t other = 0; other < poses_.size(); ++other) {
      if (other == c.value) continue;
      const std::pair<ComponentId, ComponentId> pair = std::minmax(c, ComponentId(other));
      if (const std::optional<TooDeep> found = too_deep(pair.first, pair.second)) {
        found_[pair] = *found;
      } else {
        found_.erase(pair);
      }
    }
  }

  std::optional<TooDeep> first() const {
    if (found_.empty()) return {};
    return found_.begin()->second;
  }

 private:
  std::optional<TooDeep> too_deep(ComponentId a, ComponentId b) {
    if (poses_[a.value] == poses_[b.value] || !overlaps(bounds_[a.value], bounds_[b.value])) return {};
    const ComponentPair* known = pairs_.find(a, b);
    const double allowed = known != nullptr ? known->allowed_depth : pairs_.tolerance;
    const PlacedShape first{&shape(a), transform_from_pose(poses_[a.value])};
    const PlacedShape second{&shape(b), transform_from_pose(poses_[b.value])};
    for (const PlacedShape& placed : {first, second})
      if (placed.shape->empty() || !placed.shape->winding().closed()) return {};
    DepthOptions options;
    options.gap = kSlack * pairs_.tolerance;
    const double depth = solid_depth(first, second, options).attained;
    if (depth <= allowed + kSlack * pairs_.tolerance) return {};
    return TooDeep{a, b, depth, allowed};
  }

  const SolidShape& shape(ComponentId c) {
    const auto known = shapes_.find(c);
    return known != shapes_.end() ? known->second : shapes_.emplace(c, SolidShape(assembly_[c])).first->second;
  }

  const Assembly& assembly_;
  const PairStates& pairs_;
  std::vector<Pose> poses_;
  std::vector<Aabb> bounds_;
  std::map<ComponentId, SolidShape> shapes_;
  std::map<std::pair<ComponentId, ComponentId>, TooDeep> found_;
};

}  // namespace

RestorableState last_valid_state(const Assembly& assembly, const PairStates& pairs, const JournalContents& contents) {
  DepthCheck check(assembly, pairs);
  std::vector<bool> is_moved(assembly.components.size());
  for (std::size_t i = 0; i < contents.done_count; ++i) {
    const SessionEntry& entry = contents.entries[i];
    check.put(entry, entry.frames.back().pose);
    for (const ComponentId c : entry.components) is_moved[c.value] = true;
  }
  for (std::uint32_t c = 0; c < is_moved.size(); ++c)
    if (is_moved[c]) check.check(ComponentId(c));

  RestorableState state{contents.done_count, check.first()};
  while (state.done_count > 0 && check.first()) {
    const SessionEntry& entry = contents.entries[--state.done_count];
    check.put(entry, entry.frames.front().pose);
    for (const ComponentId c : entry.components) check.check(c);
  }
  return state;
}

}  // namespace dismantle
