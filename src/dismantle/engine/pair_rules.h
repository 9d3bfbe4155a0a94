// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/span.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The test for the triangle pairs of a component pair.
enum class PairTest : std::uint8_t {
  Ordinary,   ///< Apart in the assembled state: the continuous test of the options.
  Certified,  ///< Contact, overlapping, or no longer free: the certified continuous test with ghost surfaces.
  Discrete,   ///< Free, in S_i: the intersection test at the end of the step.
  None,       ///< Its triangles are not tested.
};

/// The rule of a component pair.
struct PairRule {
  PairTest test = PairTest::Ordinary;  ///< Test for its triangle pairs.
  ///@{ Added to the index of a vertex of `a` or `b`: the slot of its displaced position in GhostTriangles::displaced.
  std::uint32_t ghost_a = 0, ghost_b = 0;
  ///@}
  friend bool operator==(const PairRule&, const PairRule&) = default;
};

/// A slot of the hash table of rules.
struct PairRuleEntry {
  static constexpr std::uint32_t kFree = 0xffffffffu;  ///< `a` of an empty slot.
  std::uint32_t a = kFree;                             ///< The smaller component index.
  std::uint32_t b = kFree;                             ///< The larger component index.
  PairRule rule;                                       ///< The pair's rule.
};

/// View of the rules for kernels: a hash table with open addressing. Pairs that are not in it are Ordinary.
struct PairRulesView {
  Span<const PairRuleEntry> table;  ///< Its size is a power of two; at most half of it is used.

  /// The hash of a pair: its first slot, modulo the size of the table. @pre a < b
  DISMANTLE_HOST_DEVICE static std::size_t hash(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t mixed = (static_cast<std::uint64_t>(a) << 32 | b) * 0x9E3779B97F4A7C15ull;
    return static_cast<std::size_t>(mixed >> 32);
  }

  /// The rule of a pair. @pre a < b
  DISMANTLE_HOST_DEVICE PairRule find(std::uint32_t a, std::uint32_t b) const {
    for (std::size_t i = hash(a, b);; ++i) {
      const PairRuleEntry& entry = table[i & (table.size() - 1)];
      if (entry.a == a && entry.b == b) return entry.rule;
      if (entry.a == PairRuleEntry::kFree) return {};
    }
  }
};

/// The rules of all component pairs of an assembly.
class PairRules {
 public:
  /// Makes the rules from the states of the pairs in the assembled state; all ghosts are those at the vertices' own
  /// slots.
  explicit PairRules(const PairStates& states);

  /// A view that is valid as long as this is.
  PairRulesView view() const { return {table_}; }
  /// Changes the rule of a pair. @pre a < b; the pair was in the states
  void set(ComponentId a, ComponentId b, const PairRule& rule);

 private:
  PairRuleEntry& slot(ComponentId a, ComponentId b);

  std::vector<PairRuleEntry> table_;
};

}  // namespace dismantle
