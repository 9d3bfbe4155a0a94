// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/core/id.h"

#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// The unit of undo: a rigid motion of a set, its removal or return, or both.
struct SessionEntry {
  std::string label;                    ///< "move screw", "take out screw", "put back screw"
  std::vector<ComponentId> components;  ///< The moving set; not empty, all at one pose.
  std::vector<Frame> frames;            ///< As in Move: the first is the start pose at time 0.
  std::vector<bool> removed_before;     ///< For each component of the set: removed before the entry.
  std::optional<bool> removed_after;    ///< Removed after the entry; none: unchanged.
  friend bool operator==(const SessionEntry&, const SessionEntry&) = default;
};

/// True if the set moved.
inline bool has_moved(const SessionEntry& entry) {
  return entry.frames.size() > 1;
}

/// True if undoing the entry changes anything.
inline bool has_effect(const SessionEntry& entry) {
  return has_moved(entry) || entry.removed_after.has_value();
}

}  // namespace dismantle
