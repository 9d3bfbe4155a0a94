// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/fasteners/fastener.h"
#include "dismantle/features/axis_frame.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dismantle {

/// A screw, or a standoff with a stud, cut by planes across its axis, from its tip to its head.
struct Shank {
  AxisFrame frame;                ///< `direction` is from the tip to the head [assembly frame].
  std::vector<double> positions;  ///< Of the planes along the axis, ascending [mm]; the first one is beyond the tip.
  std::vector<double> radii;      ///< Of the component in each plane [mm].
  std::size_t end = 0;            ///< The planes from 1 to this one, without it, cut the shank; the rest cut the head.
  double step = 0;                ///< Distance of neighbouring planes [mm].
  double thread_radius = 0;       ///< Nominal where it is known, else as measured at the tip [mm].
  double head_radius = 0;         ///< Largest radius [mm].
  bool has_head = false;          ///< False for set screws and threaded rods.

  /// The distance from the tip to the far side of what a plane stands for [mm].
  double from_tip(std::size_t plane) const { return step * static_cast<double>(plane); }
};

/// The shank of a screw or of a standoff; nothing for a standoff without a stud and for all other fasteners.
std::optional<Shank> shank_of(const Component& component, const Fastener& fastener);

}  // namespace dismantle
