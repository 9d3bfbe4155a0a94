// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// Number of listed pairs in each state.
struct PairCounts {
  std::size_t near = 0;      ///< Apart, but closer than the clearance asked for.
  std::size_t contact = 0;   ///< Touching within the tolerance.
  std::size_t fit = 0;       ///< Overlapping by a fit.
  std::size_t embedded = 0;  ///< Overlapping deeper than a fit.

  friend bool operator==(const PairCounts&, const PairCounts&) = default;
};

/// Counts the pairs by state.
PairCounts count_pairs(const PairStates& states);

/// The pairs by severity: embedded, fit, contact, near; within a state the deepest, then the nearest first; ties in the
/// order of PairStates.
std::vector<ComponentPair> worst_first(const PairStates& states);

/// A description of a pair's state for readers: "touching within the tolerance", ...
std::string_view explanation_of(PairState state);

/// The clash report that other tools read: docs/formats.md, `dismantle check --json`; one pair a line, in the order of
/// PairStates. Bytes of names that are not UTF-8 are replaced.
std::string check_report_json(const Assembly& assembly, const PairStates& states);

/// The clash report as text for a terminal: a summary and a table of the pairs, worst first.
std::string check_report_text(const Assembly& assembly, const PairStates& states);

}  // namespace dismantle
