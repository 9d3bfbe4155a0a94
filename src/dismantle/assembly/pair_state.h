// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"

#include <string_view>
#include <vector>

namespace dismantle {

/// The relation of two components in the assembled state (docs/guarantee.md).
enum class PairState {
  Clear,     ///< Apart; allowed penetration: the tolerance.
  Near,      ///< Apart, but closer than the clearance that the user gave.
  Contact,   ///< Touching, or overlapping by no more than the tolerance; allowed: the tolerance.
  Fit,       ///< Overlapping by no more than the fit limit; allowed: the initial depth plus the tolerance.
  Embedded,  ///< Overlapping more deeply (the paper's S_i): free until apart, then Clear permanently.
};

/// The name of a state in files: "clear", "near", "contact", "fit" or "embedded".
std::string_view name_of(PairState state);

/// A pair of components in the assembled state, and its allowance.
struct ComponentPair {
  ///@{ The components, a < b.
  ComponentId a, b;
  ///@}
  PairState state = PairState::Clear;  ///< Its relation.
  double distance = 0;                 ///< Distance where apart, else 0 [mm].
  double penetration = 0;              ///< Largest depth of an intersecting triangle pair [mm].
  double allowed_penetration = 0;      ///< Depth allowed at any time [mm]; infinite for Embedded.
  std::size_t triangle_pairs = 0;      ///< Number of triangle pairs that intersect; touching counts.
  friend bool operator==(const ComponentPair&, const ComponentPair&) = default;
};

/// The states of all pairs of an assembly.
struct PairStates {
  double tolerance = 0;              ///< Depth that counts as touching [mm].
  std::vector<ComponentPair> pairs;  ///< Every pair that is not Clear, ordered by (a, b).
  /// The pair of two components in either order; null where it is Clear.
  const ComponentPair* find(ComponentId a, ComponentId b) const;
};

}  // namespace dismantle
