// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"

#include <string_view>
#include <vector>

namespace dismantle {

/// How two components stand to each other in the assembled state (docs/guarantee.md).
enum class PairState {
  Clear,     ///< Apart; allowed penetration: the tolerance.
  Near,      ///< Apart, but closer than the clearance that the user asked about.
  Contact,   ///< Touching, or overlapping by no more than the tolerance; allowed: the tolerance.
  Fit,       ///< Overlapping by no more than the fit limit; allowed: the initial depth plus the tolerance.
  Embedded,  ///< Overlapping more deeply (the paper's S_i): free until apart, then Clear for good.
};

/// "clear", "near", "contact", "fit", "embedded": as files have it.
std::string_view name_of(PairState state);

/// A pair of components, what was found about it in the assembled state, and what it is allowed.
struct ComponentPair {
  ComponentId a, b;  ///< a < b
  PairState state = PairState::Clear;
  double distance = 0;             ///< Least distance where apart, else 0 [mm].
  double penetration = 0;          ///< Largest depth of an intersecting triangle pair [mm].
  double allowed_penetration = 0;  ///< [mm]; infinite for Embedded.
  std::size_t triangle_pairs = 0;  ///< Triangle pairs that intersect (touching counts).
  friend bool operator==(const ComponentPair&, const ComponentPair&) = default;
};

/// Every pair that is not Clear, ordered by (a, b); all others are Clear.
struct PairStates {
  double tolerance = 0;  ///< [mm]
  std::vector<ComponentPair> pairs;
  /// The listed pair (in either order), or null where it is Clear.
  const ComponentPair* find(ComponentId a, ComponentId b) const;
};

}  // namespace dismantle
