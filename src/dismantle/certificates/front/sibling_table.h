// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

/// Hash table with open addressing that finds siblings. Key: the pair of nodes that a pair would merge into, and the
/// component whose node is halved; value: the first of the two halves. A collision of all 64 bits of the hash merely
/// misses a merge.
class SiblingTable {
 public:
  /// @param halves upper bound of the number of calls of match()
  explicit SiblingTable(std::size_t halves) : table_(std::bit_ceil(2 * halves + 1)) {}

  /// The other half if it was seen before; else stores this one.
  /// @param up_a, up_b the pair of nodes that the halves would merge into
  /// @param halves_a the halves differ in the node of A
  /// @param pair index of this half
  std::optional<std::uint32_t> match(std::uint32_t up_a, std::uint32_t up_b, bool halves_a, std::uint32_t pair) {
    const std::uint64_t key = ((std::uint64_t{up_a} << 32 | up_b) + 1) * 0x9E3779B97F4A7C15ull + halves_a;
    const std::uint64_t hash = (key ^ key >> 29) * 0xBF58476D1CE4E5B9ull;
    const auto tag = static_cast<std::uint32_t>(hash);
    for (std::size_t slot = hash >> 32;; ++slot) {
      Entry& entry = table_[slot & (table_.size() - 1)];
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
