// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/span.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Which test decides the triangle pairs of a component pair.
enum class PairTest : std::uint8_t {
  Ordinary,   ///< Apart at the start: the continuous test that the options name.
  Certified,  ///< In contact, fit or parted: the certified test with an allowance.
  Discrete,   ///< Embedded, in S_i: do they intersect at the end of the step.
};

/// What the narrow phase has to know of a component pair.
struct PairRule {
  PairTest test = PairTest::Ordinary;
  double allowed_penetration = 0;  ///< [mm]; of no meaning for Discrete
};

/// One place of the table of rules; components a < b.
struct PairRuleEntry {
  static constexpr std::uint32_t kFree = 0xffffffffu;
  std::uint32_t a = kFree, b = kFree;
  PairRule rule;
};

/// The rules as kernels see them: a hash table with open addressing; pairs that are not in it are ordinary.
struct PairRulesView {
  Span<const PairRuleEntry> table;  ///< A power of two, at most half full.
  double tolerance = 0;             ///< [mm]

  DISMANTLE_HOST_DEVICE static std::size_t place(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t mixed = (static_cast<std::uint64_t>(a) << 32 | b) * 0x9E3779B97F4A7C15ull;
    return static_cast<std::size_t>(mixed >> 32);
  }

  /// @pre a < b
  DISMANTLE_HOST_DEVICE PairRule find(std::uint32_t a, std::uint32_t b) const {
    for (std::size_t i = place(a, b);; ++i) {
      const PairRuleEntry& entry = table[i & (table.size() - 1)];
      if (entry.a == a && entry.b == b) return entry.rule;
      if (entry.a == PairRuleEntry::kFree) return {PairTest::Ordinary, tolerance};
    }
  }
};

/// The rules of an assembly's pairs.
class PairRules {
 public:
  explicit PairRules(const PairStates& states);

  PairRulesView view() const { return {table_, tolerance_}; }
  double tolerance() const { return tolerance_; }
  /// The pair has parted: it may be no deeper than the tolerance from now on. Certified, whatever the options name: at
  /// the moment of parting it may still overlap by less than that. @pre it has been embedded
  void part(ComponentId a, ComponentId b);

 private:
  std::vector<PairRuleEntry> table_;
  double tolerance_;
};

}  // namespace dismantle
