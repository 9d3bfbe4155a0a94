// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

/// An open hash table from the pair that a pair of nodes would merge into, and whether it is half of its A or its B, to
/// the first of the two halves seen. Two pairs that share 64 bits of hash would merely miss a merge.
class SiblingTable {
 public:
  explicit SiblingTable(std::size_t halves) : table_(std::bit_ceil(2 * halves + 1)) {}

  /// The other half if it came before; else this one is kept for it.
  std::optional<std::uint32_t> meet(std::uint32_t up_a, std::uint32_t up_b, bool halves_a, std::uint32_t pair) {
    const std::uint64_t key = ((std::uint64_t{up_a} << 32 | up_b) + 1) * 0x9E3779B97F4A7C15ull + halves_a;
    const std::uint64_t hash = (key ^ key >> 29) * 0xBF58476D1CE4E5B9ull;
    const auto tag = static_cast<std::uint32_t>(hash);
    for (std::size_t place = hash >> 32;; ++place) {
      Entry& entry = table_[place & (table_.size() - 1)];
      if (entry.pair == 0) {
        entry = {tag, pair + 1};
        return {};
      }
      if (entry.tag == tag) return entry.pair - 1;
    }
  }

 private:
  struct Entry {
    std::uint32_t tag = 0, pair = 0;
  };
  std::vector<Entry> table_;
};

}  // namespace dismantle
