// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/pair_state.h"
#include "dismantle/assembly/path.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dismantle {

/// Pairs of components a < b, ordered.
using PairList = std::vector<std::pair<ComponentId, ComponentId>>;

/// One thing that was done in a session, and the unit of undo: a rigid motion of a set, or that it was taken away or
/// put back, or both.
struct SessionEntry {
  std::string label;                    ///< "move screw", "take out screw", "put back screw"
  std::vector<ComponentId> components;  ///< The set; not empty, all at one pose.
  std::vector<Frame> frames;            ///< As in Move: the first is where the set was at time 0.
  PairList embedded_before;             ///< The pairs that were embedded before it.
  PairList embedded_after;              ///< And after it.
  std::vector<bool> removed_before;     ///< Of each component of the set: whether it was taken away before.
  std::optional<bool> removed_after;    ///< What it makes of the set; none: as before.
  friend bool operator==(const SessionEntry&, const SessionEntry&) = default;
};

/// Whether the set moved at all.
inline bool has_moved(const SessionEntry& entry) {
  return entry.frames.size() > 1;
}

/// Whether undoing it would change anything.
inline bool has_effect(const SessionEntry& entry) {
  return has_moved(entry) || entry.removed_after.has_value();
}

}  // namespace dismantle
