// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/span.h"
#include "dismantle/math/vec3.h"

namespace dismantle {

/// A component that gives: an O-ring, a circlip, a seal, a cable.
struct FlexiblePart {
  ComponentId component;  ///< Which one.
  double overlap = 0;     ///< Depth that it and what it touches may get in each other while one of them moves [mm].
  Vec3 axis;              ///< Of a ring, unit [assembly]: it comes off along this axis only. Zero: in any direction.
  friend bool operator==(const FlexiblePart&, const FlexiblePart&) = default;
};

/// Declares the overlaps of flexible components and all that they touch or overlap in the assembled state.
inline void allow_flexible(PairStates& states, Span<const FlexiblePart> parts) {
  for (const FlexiblePart& part : parts)
    for (const ComponentPair pair : std::vector<ComponentPair>(states.pairs))
      if ((pair.a == part.component || pair.b == part.component) &&
          (pair.state == PairState::Contact || pair.state == PairState::Overlapping))
        states.declare(pair.a, pair.b, part.overlap);
}

}  // namespace dismantle
