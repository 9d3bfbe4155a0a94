// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// How many pairs are in each state, of those that PairStates lists.
struct PairCounts {
  std::size_t near = 0, contact = 0, fit = 0, embedded = 0;
  friend bool operator==(const PairCounts&, const PairCounts&) = default;
};

PairCounts count_pairs(const PairStates& states);

/// The pairs in the order in which one wants to look at them: embedded, fit, contact, near; in each the deepest, then
/// the nearest first; equal ones as PairStates has them.
std::vector<ComponentPair> worst_first(const PairStates& states);

/// A pair's state in words for whoever does not know them: "touching within the tolerance", ...
std::string_view explanation_of(PairState state);

/// The clash report that other tools read: docs/formats.md, `dismantle check --json`; a pair a line, in PairStates'
/// order. Names that are not UTF-8 have their wrong bytes replaced.
std::string check_report_json(const Assembly& assembly, const PairStates& states);

/// The clash report as text for a terminal: a summary and a table of the pairs, worst first.
std::string check_report_text(const Assembly& assembly, const PairStates& states);

}  // namespace dismantle
