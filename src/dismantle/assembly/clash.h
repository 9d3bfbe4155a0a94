// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/math/vec3.h"

#include <string_view>
#include <vector>

namespace dismantle {

/// The relation of two components that meet or nearly meet in the assembled state.
enum class ClashState {
  Near,         ///< Apart, but closer than the clearance asked for.
  Contact,      ///< Touching: no further apart, and no deeper in each other, than the tolerance.
  Overlapping,  ///< Deeper in each other.
};

/// The name of a state in files: "near", "contact" or "overlapping".
std::string_view name_of(ClashState state);

/// Two components that meet or nearly meet in the assembled state.
struct Clash {
  ///@{ The components, a < b.
  ComponentId a, b;
  ///@}
  ClashState state = ClashState::Near;  ///< Their relation.
  ComponentId contained;                ///< The one that lies wholly inside the other one; invalid if none does.
  double distance = 0;                  ///< Distance of the surfaces where they are apart, else 0 [mm].
  double depth = 0;                     ///< Depth of the pair, an upper bound; 0 where they do not overlap [mm].
  double depth_attained = 0;            ///< Depth of `deepest_at`, a lower bound [mm].
  Vec3 deepest_at;           ///< The deepest point found, or else one where they are nearest [mm, assembly frame].
  double volume = 0;         ///< Volume in common of a pair that overlaps [mm^3].
  double volume_error = 0;   ///< Standard error of the volume [mm^3].
  bool depth_loose = false;  ///< The search for the depth ended early: its bounds may be far apart.
  friend bool operator==(const Clash&, const Clash&) = default;
};

/// All clashes of an assembly.
struct Clashes {
  double tolerance = 0;      ///< Depth that counts as touching [mm].
  std::vector<Clash> pairs;  ///< Ordered by (a, b).
};

}  // namespace dismantle
