// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace dismantle {

/// The relation of two components in the assembled state (docs/guarantee.md).
enum class PairState {
  Clear,        ///< Apart.
  Near,         ///< Apart, but closer than the clearance that the user gave.
  Contact,      ///< Touching, or overlapping by no more than the tolerance.
  Overlapping,  ///< Deeper in each other than the tolerance.
  Free,         ///< Touching or overlapping, and not checked until they have been apart (ClassifyRule::Paper).
};

/// The name of a state: "clear", "near", "contact", "overlapping" or "free".
std::string_view name_of(PairState state);

/// A pair of components in the assembled state, and its allowance.
struct ComponentPair {
  ///@{ The components, a < b.
  ComponentId a, b;
  ///@}
  PairState state = PairState::Clear;  ///< Its relation.
  double distance = 0;                 ///< Distance where apart, else 0 [mm].
  double depth = 0;  ///< Depth of the two solids [mm]: an upper bound, or a lower one where the search ended early.
  /// Depth allowed until the two have been apart; then it is the tolerance [mm]. Infinite for Free.
  double allowed_depth = 0;
  double declared = 0;  ///< Depth that the user allows them [mm]; 0: none.
  friend bool operator==(const ComponentPair&, const ComponentPair&) = default;
};

/// The states of all pairs of an assembly.
struct PairStates {
  double tolerance = 0;              ///< Depth that counts as touching [mm].
  std::vector<ComponentPair> pairs;  ///< Every pair that is not Clear, ordered by (a, b).
  /// The pair of two components in either order; null where it is Clear.
  const ComponentPair* find(ComponentId a, ComponentId b) const;
  /// Gives pairs that are listed the allowances of `pairs` where these are larger: an engine allows cylinders that turn
  /// in each other more than classify_pairs() (MotionEngine::overlapping_pairs()).
  void raise_allowances(const std::vector<ComponentPair>& pairs);
  /// Raises the allowance of a pair to a declared depth [mm]. @return false if it was allowed that already
  /// @pre the pair is listed
  bool declare(ComponentId a, ComponentId b, double depth);
};

}  // namespace dismantle
