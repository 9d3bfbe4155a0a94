// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/session/journal.h"

#include <cstddef>
#include <optional>

namespace dismantle {

/// Two components that are deeper in each other than they may be.
struct TooDeep {
  ///@{ The components, a < b.
  ComponentId a, b;
  ///@}
  double depth = 0;    ///< Found at a point [mm].
  double allowed = 0;  ///< [mm]
};

/// The state of a journal that may be restored.
struct RestorableState {
  std::size_t done_count = 0;       ///< Number of the first entries that are in effect in it.
  std::optional<TooDeep> too_deep;  ///< Why it is not the last state of the journal; none if it is.
};

/// The last state of a journal's entries in effect in which no closed component is deeper in another one than the
/// guarantee allows (docs/guarantee.md): by the depths of the solids, without the engine that made the journal.
/// @param pairs with the allowances of the engine
RestorableState last_valid_state(const Assembly& assembly, const PairStates& pairs, const JournalContents& contents);

}  // namespace dismantle
