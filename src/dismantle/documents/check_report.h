// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/clash.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// Number of clashes in each state.
struct ClashCounts {
  std::size_t near = 0;         ///< Apart, but closer than the clearance asked for.
  std::size_t contact = 0;      ///< Touching within the tolerance.
  std::size_t overlapping = 0;  ///< Deeper in each other.
  std::size_t contained = 0;    ///< Those of `overlapping` of which one is wholly inside the other.

  friend bool operator==(const ClashCounts&, const ClashCounts&) = default;
};

/// Counts the clashes by state.
ClashCounts count_clashes(const Clashes& clashes);

/// The clashes by severity: overlapping, contact, near; within a state the deepest, then the nearest first; ties in the
/// order of Clashes.
std::vector<Clash> worst_first(const Clashes& clashes);

/// A description of a state for readers: "touching: no deeper than the tolerance", ...
std::string_view explanation_of(ClashState state);

/// The depth for readers: four digits, 0 where it is no more than a tenth of the tolerance, which is the accuracy of
/// the bound; "up to" before a bound that may be far above the depth [mm].
std::string depth_text(const Clash& clash, double tolerance);

/// The clash report that other tools read, version 2: docs/formats.md, `dismantle check --json`; one pair a line, in
/// the order of Clashes. Bytes of names that are not UTF-8 are replaced.
std::string check_report_json(const Assembly& assembly, const Clashes& clashes);

/// The clash report as text for a terminal: a summary and a table of the pairs, worst first.
std::string check_report_text(const Assembly& assembly, const Clashes& clashes);

}  // namespace dismantle
