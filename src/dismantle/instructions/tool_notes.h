// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/fasteners/fastener.h"
#include "dismantle/instructions/motion_text.h"

#include <compare>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// A tool, in the order of lists: by the form that it grips, then by size.
struct Tool {
  Fastener::Drive drive = Fastener::Drive::None;  ///< The form that it grips.
  double size = 0;                                ///< As Fastener::drive_size.
  std::string text;                               ///< "4 mm hex key".
  friend auto operator<=>(const Tool&, const Tool&) = default;
};

/// The tools for a component, and sentences about its threads.
struct ToolNotes {
  std::vector<Tool> tools;           ///< Without duplicates, in order.
  std::vector<std::string> threads;  ///< "Right-hand thread M5, pitch 0.8 mm. ..."
};

/// The tools and threads of a component along the first leg of its removal: of the fastener that it is; for all
/// other components of modelled threads about the axis of the motion, and of hexagons about it, where the component is
/// turned or of the size of a fastener.
/// @pre `legs` is not empty
ToolNotes tool_notes(const Component& component, const std::optional<Fastener>& fastener, const RemovalMove& removal,
                     const std::vector<Leg>& legs, PathDirection direction);

/// True if a leg is along a fastener's axis.
bool comes_along_axis(const Component& component, const Fastener& fastener, const RemovalMove& removal, const Leg& leg);

/// True for what is turned to take it out: screws, nuts and standoffs.
bool is_threaded(const Fastener& fastener);

}  // namespace dismantle
